// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/regressor.hpp"
#include "diagnose/regressor_score.hpp"

namespace plumb::offline {

/// A series of whole waves at one joint or several, as one candidate.
struct SeriesFound {
  EffectEntry entry;  // with the number of waves, and size and slope of the prior
  RegressorScore scored;
};

/// The series of these joints, in one solve. A joint stays in it if its own evidence beside the
/// others is above kSupported, and the prior is that of the largest evidence: wave k of a standard
/// deviation of size k^-slope. The evidence given is the mean over the grid of both that was tried,
/// so that the choice costs what it should. [MacKay 1992] None if no joint is left. Cost: poses *
/// (waves of all joints)^2, then (waves of all joints)^3 / 3 for each prior that is tried.
std::optional<SeriesFound> scan_series(const Scorer& scorer, const std::vector<int>& joints);

/// One series of many small waves at all of these joints, none of which need show alone. A joint
/// stays in it if its fast waves, which no smooth law imitates, have evidence beside the others;
/// those of kFewestJointsOfAll joints must have kFastWavesPay. The prior is that of the largest
/// evidence; the evidence given pays for the grid in which it is looked for. None if the evidence,
/// less what was `paid` for the search, does not support it. Cost: as above, but only a few priors
/// are tried.
std::optional<SeriesFound> scan_series_of_all(const Scorer& scorer, const std::vector<int>& joints,
                                              double paid);

/// Whether one of the effects is a series of waves at that joint.
bool has_series_at(const std::vector<EffectEntry>& effects, int joint);

/// One series as it stands, with its prior as it is.
RegressorScore score_series(const Scorer& scorer, const EffectEntry& entry);

/// Its columns: 1 is one standard deviation of the prior.
Regressor series_regressor(const WhitenedFit& whitened, const EffectEntry& entry);

/// The error of each joint, RMS over a turn, in words: "7.1 µrad RMS at J2, 4.0 at J3, less at the
/// others".
std::string sizes_of(const WhitenedFit& whitened, const EffectEntry& entry,
                     const RegressorScore& scored);

/// Its largest waves in words.
std::string peaks_of(const WhitenedFit& whitened, const EffectEntry& entry,
                     const RegressorScore& scored);

/// The first waves of a series alone: what a smooth law could be mistaken for.
Regressor smooth_part(const WhitenedFit& whitened, const Regressor& series);

}  // namespace plumb::offline
