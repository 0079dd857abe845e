// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "tree/rows.hpp"
#include "tree/scan.hpp"

namespace plumb::offline {

/// Best split of a cell along a weighted sum of inputs, or `along_axis` if none lowers the RSS by a
/// twentieth more. Where two planes meet, their difference is normal to the fold: from the best
/// axis split and from the direction of strongest curvature, that fold is followed a few times
/// [Breiman 1993, hinging hyperplanes]. Cost: a sort and a scan a direction.
SplitCandidate oblique_split(const TrainingRows& rows, std::span<const int> which,
                             const SplitCandidate& along_axis, int min_samples);

}  // namespace plumb::offline
