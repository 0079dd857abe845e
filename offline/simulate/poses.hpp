// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/simulation_plan.hpp"

namespace plumb::offline::sim {

/// The distinct poses of a plan in the order in which they are visited: its own q, or poses drawn
/// inside the joint limits [rad] or [m] according to plan.choice.
RowsN distinct_poses(const SimulationPlan& plan, const Eigen::VectorXd& q_min,
                     const Eigen::VectorXd& q_max);

}  // namespace plumb::offline::sim
