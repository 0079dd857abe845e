// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "simulate/simulation_plan.hpp"
#include "simulate/visit.hpp"

namespace plumb::offline::sim {

/// The errors of the drives [rad] or [m] at every visit, shape (visits, joints), drawn anew at
/// every stop: readings that are taken in place share them. No rows if the joints do not scatter.
RowsN draw_scatter(const SimulationPlan& plan, const std::vector<Visit>& visits);

}  // namespace plumb::offline::sim
