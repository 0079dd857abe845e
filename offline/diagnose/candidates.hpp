// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/diagnosis.hpp"
#include "diagnose/scan.hpp"

namespace plumb::offline {

/// What the first scan found, for the reader: best first, with held-out errors alone and after the
/// best one, parameters, and what each cannot be told from.
std::vector<Candidate> candidates_of(const WhitenedFit& whitened, const Scan& scan);

/// What the best pattern of a scan amounts to at that whitened fit.
UnknownStructure unknown_structure(const WhitenedFit& whitened, const Found& pattern);

}  // namespace plumb::offline
