// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// C99 code that is the same for every model except for the prefix of its symbols, written as '@'.
/// Line by line what runtime/tree_walk.hpp does, so that the bits are the same.
namespace plumb::offline {

/// Types of the tables.
std::string_view c_tree_types();

/// Functions that come before the function for the user. They need, besides the tables, the
/// constants @_joints, @_terms, @_room, @_region_fade and @_soft_share.
std::string_view c_tree_functions();

/// The function for the user, without its comment. It needs also @_shapes, @_shape_count, @_trees,
/// @_middle, @_half_inverse, @_fade_inverse and @_max_position.
std::string_view c_tree_error();

}  // namespace plumb::offline
