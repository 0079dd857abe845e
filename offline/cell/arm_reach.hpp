// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/arm_columns.hpp"

namespace plumb::offline {

/// Numbers that no arm can have are errors: joints beyond 1e4 rad or m, points beyond 1e4 m. They
/// come from a wrong unit or a lost decimal point, and sines of them mean nothing.
void check_reach(const Table& table, const ArmColumns& columns, ProblemList& problems);

}  // namespace plumb::offline
