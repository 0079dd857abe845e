// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/blind/marks.hpp"

namespace plumb::tests {

/// The marks of the study of narrow measurements. `granted`: see marks_of.
std::vector<Mark> narrow_marks_of(const std::vector<Score>& scores, double granted);

/// What became of each kind, as Markdown.
std::string narrow_table_of(const std::vector<Score>& scores);

}  // namespace plumb::tests
