// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/blind/marks.hpp"

namespace plumb::tests {

/// The marks of the study of measured orientations. `granted`: see marks_of.
std::vector<Mark> orientation_marks_of(const std::vector<Score>& scores, double granted);

/// What became of each kind, as Markdown.
std::string orientation_table_of(const std::vector<Score>& scores);

}  // namespace plumb::tests
