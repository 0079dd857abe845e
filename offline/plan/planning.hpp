// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plan/pose_plan.hpp"

namespace plumb::offline {

/// Throws Failure (kInput, E-PLAN-POINT) for a cell with readings about artefacts.
void check_plannable(const Cell& cell);

/// D-optimal poses [Fedorov 1972] for geometry and the effects of the cell, given those measured;
/// or those that tell two effects A and B apart: poses, and what else matters for the two, are
/// chosen so that the evidence for A over B is expected to be large if A is true with its fitted
/// size, and small if B is; the smaller of both counts. Linearised at the fitted arm, or at the
/// nominal one if there is no fit yet; then both effects are taken to have their typical sizes.
/// Throws Failure: E-PLAN-BOX, E-PLAN-SAME (no measurement of the point tells the two apart).
PosePlan plan_poses(const Cell& cell, const Measurements& measured, const PlanRequest& request);

}  // namespace plumb::offline
