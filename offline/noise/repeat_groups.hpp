// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline {

constexpr int kEnoughRepeats = 5;  // readings beyond the first: fewer measure no noise

/// Groups of rows whose differences are noise and nothing else: one pose in one set-up, under the
/// same load, reached from the same side, and all temperatures within half a kelvin. Repeats of a
/// pose under another context tell of what the context does to the arm. The noise floor and the
/// test of lack of fit both ask here. Numbered 0 ... groups - 1, shape (rows,).
///
/// The side is what the columns dir_jN state, and the sign of the last moves where these follow
/// from the row before; the latter only if enough repeats are left.
std::vector<int> repeat_groups(const Measurements& measured);

}  // namespace plumb::offline
