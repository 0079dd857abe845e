// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tree/growth.hpp"

/// Rules for when to stop splitting, other than cross-validation (choice.hpp).
namespace plumb::offline {

/// The smallest number of leaves at which one more split lowers the remaining RSS by less than
/// `share` of it. The published study uses share = 0.02.
int leaves_at_gain(const GrownTree& tree, double share);

/// A split stands if its parent does and it lowers the residual variance by at least
/// (share sigma_root)^2: delta = RSS0 / (N - d) - (RSS1 + RSS2) / (N - 2 d)
/// [Potts & Sammut 2005]. One output.
Splits stop_by_delta(const GrownTree& tree, double share);

/// A split stands if its parent does and Chow's test rejects that both sides are one model:
/// F = (RSS0 - RSS1 - RSS2) (N - 2 d) / (d (RSS1 + RSS2)) has p < alpha. One output.
/// Because the split is the best of many, p is multiplied by their number (Bonferroni).
Splits stop_by_chow(const GrownTree& tree, double alpha);

}  // namespace plumb::offline
