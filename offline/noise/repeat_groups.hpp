// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// Repeats measure the noise if there are so many readings beyond the first of each pose: five
/// of three axes tell a standard deviation to 18 %. Users are told (docs/model.md).
constexpr int kEnoughRepeats = 5;

/// Number of the group of each row, 0 ... groups - 1, shape (rows,). Rows of one group differ by
/// noise only: they are of one pose in one set-up, under the same load, reached from the same side,
/// and with all temperatures within half a kelvin. Repeats under another context show the effect of
/// the context instead. Both the noise floor and the test of lack of fit use these groups.
///
/// The side is given by the columns dir_jN, and by the signs of the last moves where these follow
/// from the row before. The moves are ignored if too few repeats would be left.
std::vector<int> repeat_groups(const Measurements& measured);

}  // namespace plumb::offline
