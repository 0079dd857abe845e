// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/effect_rules.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/scan.hpp"

namespace plumb::offline {

/// What `first` may be instead, by evidence: other laws, or the same law at other joints, that come
/// within 10 nats of it or ahead of it (causes by load: also farther behind, where the arm's
/// numbers imitate nearly all of their motion), and that can imitate it as it can imitate them (80
/// % of the motion, either way). Finer laws of the same cause are no alternatives: a joint that
/// yields is one finding, whatever law describes it best.
///
/// @param excluded  Laws that the data cannot show, and that the scan has therefore left out. One
///                  of them is also an alternative if it explains these poses better than `first`.
///
/// Cost: a pass over the poses for each candidate near `first`, and one scan of the excluded laws.
std::vector<Alternative> alternatives(const WhitenedFit& whitened, const Scan& look,
                                      const Found& first, const std::vector<Testable>& excluded);

/// Laws that a candidate or a pattern may be instead under other weights than the cell knows (see
/// rivals_under_unknown_weights), each with what to measure.
std::vector<Alternative> alternatives_under_unknown_weights(const WhitenedFit& whitened,
                                                            const Found& first);

/// The slow motion that a step, `first`, may be instead: of the same part and not abrupt (see
/// gradual_motion.hpp); or of any part, supported, and within 10 nats of it or ahead: a step has a
/// place that was chosen among all, so it imitates whatever moves slowly. Where a part seems to
/// move again and again, any slow motion that is supported is one.
///
/// @param others  Alternatives of `first`.
/// @return  Nothing where `first` is no step, or where a law of the library, as a drift, may
///          describe the slow motion: then that law is the alternative.
std::optional<Found> slow_motion_instead_of(const WhitenedFit& whitened, const Scan& look,
                                            const Found& first,
                                            const std::vector<Alternative>& others);

/// Whether two effects are names of the same finding, for instance a law and a finer law of the
/// same cause at the same joint.
bool one_finding(const EffectEntry& a, const EffectEntry& b);

/// Whether one of them is a law that the data cannot show.
bool names_what_is_not_shown(const std::vector<Alternative>& alternatives);

/// Whether some of these would be compiled and others would not.
bool of_different_fate(const EffectEntry& first, const std::vector<Alternative>& alternatives);

}  // namespace plumb::offline
