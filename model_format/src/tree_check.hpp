// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "plumb/format/model.hpp"

namespace plumb::format::internal {

/// What makes a tree unsound: a node that leads back or nowhere, a leaf reached twice or never, a
/// depth that is not the real one, an input or a number out of range. Nothing if it is sound.
std::optional<std::string> unsound_tree(const Tree& tree, std::size_t joints);

}  // namespace plumb::format::internal
