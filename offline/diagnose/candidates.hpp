// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.hpp"
#include "diagnose/scan.hpp"

namespace plumb::offline {

/// The candidates of the first scan for the report, best first: each with its held-out error alone
/// and together with the best one, its parameters, and the effects it is confounded with.
///
/// @param plain  The same fit without the scatter of the joints: errors are those of models that
///               are fitted as `fit` does.
std::vector<Candidate> candidates_of(const WhitenedFit& whitened, const WhitenedFit& plain,
                                     const Scan& scan);

/// Size and share of the best pattern of a scan at that whitened fit.
UnknownStructure unknown_structure(const WhitenedFit& whitened, const Found& pattern);

}  // namespace plumb::offline
