// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/table.hpp"
#include "program/problem_list.hpp"

namespace plumb::offline {

/// Reports impossible values in `problems`: a direction other than +1, -1, 0, a negative travel or
/// payload, a temperature below absolute zero, a time that is not ISO 8601, columns of joints that
/// the arm has not.
void check_context_columns(const Table& table, const std::vector<bool>& joint_is_angle,
                           ProblemList& problems);

}  // namespace plumb::offline
