// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "import/column_plan.hpp"
#include "import/content.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// Decides what numbered columns are, by their content. Four columns Q0 to Q3, or Q1 to Q4, whose
/// squares add up to 1 in every row are a quaternion: Q0 is its scalar part (N-IMPORT-QUAT); of Q1
/// to Q4 nobody can tell which it is, so they are left out (W-IMPORT-QUAT). So are Q1 to Q3 beside
/// joints of another name. Joints counted from 0 are counted from 1 (N-IMPORT-ZERO).
void decide_numbered(const std::vector<ColumnContent>& contents, std::vector<ColumnPlan>& plans,
                     std::vector<Problem>& remarks);

}  // namespace plumb::offline
