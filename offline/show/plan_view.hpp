// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plan/pose_plan.hpp"
#include "show/block.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// plan.csv: a row a measurement, in the order of driving: pose, joints, the nominal tool position
/// in the base frame, the side or payload where it matters, and what to do.
std::string plan_csv(const Cell& cell, const PlanRequest& request, const PosePlan& plan);

/// `result` of `plumb plan` but for `blocks`.
Json plan_json(const Cell& cell, const PlanRequest& request, const PosePlan& plan);

/// What the poses will bring, in words.
Blocks plan_blocks(const PlanRequest& request, const PosePlan& plan);

}  // namespace plumb::offline::show
