// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "tree/scan.hpp"
#include "tree/training_rows.hpp"

namespace plumb::offline {

/// The best split of a cell along a weighted sum of inputs, or `along_axis` if no such split lowers
/// the RSS by a further 5 %. The difference of the slopes of two planes is normal to the hinge
/// where they meet. Starting from the best split along an axis and from the direction of strongest
/// curvature, the split is moved to this hinge a few times [Breiman 1993, hinging hyperplanes].
/// Cost: a sort and a scan for each direction.
SplitCandidate oblique_split(const TrainingRows& rows, std::span<const int> which,
                             const SplitCandidate& along_axis, int min_samples);

}  // namespace plumb::offline
