// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/scan.hpp"

namespace plumb::offline {

/// How far each of some candidates can stand in for another: share of the fitted motion of row's
/// candidate, cleared of the model, that the columns of column's candidate reproduce; shape (n, n).
Eigen::MatrixXd reproduction(const WhitenedFit& whitened,
                             const std::vector<const Found*>& candidates);

/// Effects that are another one in disguise at the same joint, whatever the poses: never searched,
/// always named.
std::vector<std::string> disguises(const EffectEntry& entry);

/// Another effect that explains these poses exactly as well as the first supported one, or null.
const Found* tied_with_first(const WhitenedFit& whitened, const Scan& scan);

/// The measurement that tells two effects apart, in words.
std::string separating_measurement(const EffectEntry& a, const EffectEntry& b);

}  // namespace plumb::offline
