// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "import/column_plan.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// Reports the uncertainties that were divided to make them one standard deviation, and those
/// that were left out because the divisor or the axis is not known.
void say_of_uncertainties(const std::vector<ColumnPlan>& plans, std::vector<Problem>& remarks);

/// Millimetres are right for a sliding joint only. Whether the joint slides is known to the cell
/// file alone, so this is a note.
void say_of_sliding(const std::vector<ColumnPlan>& plans, std::vector<Problem>& remarks);

}  // namespace plumb::offline
