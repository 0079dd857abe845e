// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "check/convention_search.hpp"

namespace plumb::offline {

/// What the convention search found: that the files are meant otherwise (E-CHECK-CONVENTION), which
/// labels the points cannot tell (N-CHECK-UNDECIDED), or why nothing was tried
/// (N-CHECK-CONVENTION).
std::vector<Problem> convention_findings(const Cell& cell, const Detection& detection);

/// Set-ups, besides the one that the convention was searched for in, whose files are meant
/// otherwise than labelled (E-CHECK-CONVENTION). Cost: one search for each.
std::vector<Problem> other_setup_findings(const Cell& cell, const MeasurementFiles& measured);

}  // namespace plumb::offline
