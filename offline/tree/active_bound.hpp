// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// An upper bound of the number of leaves that are active (have a weight above zero) at any one
/// point of the input box; exact if the search ends within its budget. The search is branch and
/// bound over boxes: the leaves that a box meets give an upper bound, those active at its middle a
/// lower bound. The result is 1 for a crisp tree and 0 for an empty one.
int most_active_leaves(const format::Tree& tree, int inputs);

}  // namespace plumb::offline
