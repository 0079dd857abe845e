// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "import/column_plan.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// Columns that are called as joints are: as those of the cell (`joints`, from base to tip), as
/// those of Universal Robots, or with one word and the numbers 1 to n, "panda_joint1" (N-IMPORT-
/// JOINTS).
void name_joints(const std::vector<std::string>& joints, const std::vector<std::string>& units,
                 std::vector<ColumnPlan>& plans, std::vector<Problem>& remarks);

}  // namespace plumb::offline
