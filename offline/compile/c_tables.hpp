// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// The numbers of a model's trees and trained domain as constants of C, '@' for the prefix. Axes
/// whose leaves are the same share one shape. The model is sound and has a tree.
struct CTables {
  std::string sizes;  // enumerators; they stand before the types
  std::string tables;
};
CTables c_tables(const format::Model& model);

}  // namespace plumb::offline
