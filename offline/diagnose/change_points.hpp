// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/regressor.hpp"

namespace plumb::offline {

/// The best moment at which something moved once: the tool (a bumped reflector), the base (a bumped
/// tracker), or a joint (a slipped encoder). Every cut between two poses was tried.
struct ChangePoint {
  EffectEntry entry;  // `step` with after_row, of, and the joint
  double ln_bayes = 0.0;
};

/// The best cut of each kind at the whitened fit; `tried` counts them all. Cost: one pass over the
/// poses in their order, with running sums.
std::vector<ChangePoint> change_points(const WhitenedFit& whitened, int& tried);

/// Moves a step that was found on some of the poses to the best cut of all of them, at most `poses`
/// earlier or later.
void sharpen(const WhitenedFit& whitened, Eigen::Index poses, EffectEntry& step);

}  // namespace plumb::offline
