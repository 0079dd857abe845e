// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "check/identifiability.hpp"

namespace plumb::offline {

/// Numbers that other poses would tell apart (W-CHECK-SEPARATE): a sentence for each or, of many,
/// one for all.
std::vector<Problem> separation_findings(const IdentifiabilityReport& report);

/// The poses tell no number of the arm, only frame and reflector (W-CHECK-NOTHING).
std::optional<Problem> nothing_told(const Cell& cell, const IdentifiabilityReport& report);

/// Too few poses for the numbers of arm, frame and target (E-CHECK-FEW), or hardly enough
/// (W-CHECK-FEW). Each distinct pose gives its measured axes once; repeats give noise only.
std::optional<Problem> few_poses(const Cell& cell, const Measurements& measured,
                                 const IdentifiabilityReport& report);

/// What `fit` would refuse: without the held-out poses too few remain to be fitted (E-CHECK-FEW).
/// Throws as split_poses.
std::optional<Problem> few_left_to_fit(const Cell& cell, const Measurements& measured,
                                       const IdentifiabilityReport& report);

}  // namespace plumb::offline
