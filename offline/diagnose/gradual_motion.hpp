// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnose/found.hpp"

namespace plumb::offline {

/// A step is abrupt. The same part may instead move gradually, in a part of the series: as a ramp
/// around the place of the step, before or behind it, or by a jump that decays. Returns the best of
/// these if it is clearly ahead of `step`; nothing where `step` is none. Ramps and decays are at
/// least a twentieth of the series long: shorter ones are steps to everyone.
/// Cost: a score of some twenty regressors.
std::optional<Found> gradual_motion_instead_of(const WhitenedFit& whitened, const Found& step);

}  // namespace plumb::offline
