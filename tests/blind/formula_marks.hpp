// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/blind/marks.hpp"

namespace plumb::tests {

/// Marks of the study of formulas. `granted`: see marks_of.
std::vector<Mark> formula_marks_of(const std::vector<Score>& scores, double granted);

/// By hidden law: how often it was called unknown, a formula was offered, and that was good.
std::string formula_table_of(const std::vector<Score>& scores);

/// One case in one line.
std::string formula_line_of(int number, const Score& score);

}  // namespace plumb::tests
