// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "plumb/format/model.hpp"

namespace plumb::format::internal {

/// Describes the first fault of a tree: a child that does not exist or precedes its parent, a leaf
/// reached twice or never, a wrong depth, an input or a number out of range. Empty if it is sound.
std::optional<std::string> unsound_tree(const Tree& tree, std::size_t joints);

}  // namespace plumb::format::internal
