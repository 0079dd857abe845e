// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnose/diagnosis.hpp"
#include "diagnose/found.hpp"
#include "fit/calibration.hpp"

namespace plumb::offline {

/// Whether a candidate is so small that it may be the error of the law of a stronger effect in the
/// model: laws are accurate to some percent only. Waves of other wave numbers have other causes.
bool is_remainder(const Cell& cell, const WhitenedFit& whitened, const Calibration& calibration,
                  const Found& found);

/// The added effect, at one joint, that lost its evidence to the rest of the model, if one did.
/// Those in `given` and the one just added (`fresh`) stay.
std::optional<EffectEntry> lost(const Cell& cell, const WhitenedFit& whitened,
                                const Calibration& calibration,
                                const std::vector<EffectEntry>& given, const EffectEntry& fresh);

/// The added effects, at one joint each, whose sizes are not plausible; impossible ones first, then
/// the largest.
std::vector<Oversized> oversized(const Cell& cell, const WhitenedFit& whitened,
                                 const Calibration& calibration,
                                 const std::vector<EffectEntry>& given);

}  // namespace plumb::offline
