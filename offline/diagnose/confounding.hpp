// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/scan.hpp"

namespace plumb::offline {

/// How well candidates can replace each other, shape (n, n). Element (i, k): share of the fitted
/// motion of candidate i, orthogonal to the model, that the columns of candidate k reproduce.
Eigen::MatrixXd reproduction(const WhitenedFit& whitened,
                             const std::vector<const Found*>& candidates);

/// The smaller of the two shares, of `first` by each of `others` and the other way round: how well
/// the two can replace each other. Cost: one pass over the poses for each.
std::vector<double> mutual_reproduction(const WhitenedFit& whitened, const Found& first,
                                        const std::vector<const Found*>& others);

/// Effects that cause the same motion at the same joint, whatever the poses. The scan does not try
/// them; the report names them.
std::vector<std::string> disguises(const EffectEntry& entry);

/// Another effect that explains these poses exactly as well as the first supported one, or null.
const Found* tied_with_first(const WhitenedFit& whitened, const Scan& scan);

/// The measurement that tells two effects apart, in words.
std::string separating_measurement(const EffectEntry& a, const EffectEntry& b);

}  // namespace plumb::offline
