// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// No point of the box has more leaves with a say than this: an upper bound, exact if the search
/// ends before its budget does. Branch and bound over boxes: a box meets at most so many leaves,
/// its middle at least so many. 1 for a crisp tree, 0 for none.
int most_active_leaves(const format::Tree& tree, int inputs);

}  // namespace plumb::offline
