// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/blind/marks.hpp"

namespace plumb::tests {

/// The marks of the study of inconvenient arms. `granted`: see marks_of.
std::vector<Mark> inconvenient_marks_of(const std::vector<Score>& scores, double granted);

/// Tables without marks, as Markdown: every kind of arm by itself; how often the first candidate is
/// right for leads of 3 to 5, 5 to 10 and more nats; how often the true fall of the error lies
/// within one and two standard errors of the promised one.
std::string inconvenient_tables_of(const std::vector<Score>& scores);

}  // namespace plumb::tests
