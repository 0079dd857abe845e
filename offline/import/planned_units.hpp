// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "import/column_plan.hpp"
#include "import/stated_units.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// Columns that say no unit have the one that a line above the table states. N-IMPORT-STATED.
void take_stated_units(const StatedUnits& stated, const std::string& file,
                       std::vector<ColumnPlan>& plans, std::vector<Problem>& remarks);

}  // namespace plumb::offline
