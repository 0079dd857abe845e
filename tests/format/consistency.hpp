// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumb/format/model.hpp"

namespace plumb::format {

/// What the cycle could not survive in a model, found by walking and evaluating it; empty if
/// nothing. Written apart from the reader's own check and from model.hpp's promises only.
std::string inconsistency(const Model& model);

}  // namespace plumb::format
