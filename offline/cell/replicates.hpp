// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// Rows that repeat one pose: they carry one pose name, or their joints agree to 1e-9 [rad] or [m].
///
/// A name used in two files joins them only if the joints agree to 1e-3 as well, since every file
/// may number its poses from 1. Names that are empty join nothing.
///
/// @param file  Which file each row comes from, shape (n,), ascending.
/// @return      Group of each row, 0 … groups - 1 in order of first appearance, shape (n,).
/// Cost: O(n log n).
std::vector<int> replicate_groups(const std::vector<std::string_view>& names,
                                  const std::vector<int>& file, const RowsN& q);

/// Groups of rows at one pose of the arm, in whatever set-up they were measured. Across set-ups
/// they are no repeats of one reading, but one must not be fitted while another is held out.
/// Numbered as above.
std::vector<int> pose_groups(const Measurements& measured);

}  // namespace plumb::offline
