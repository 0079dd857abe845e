// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/blind/score.hpp"

namespace plumb::tests {

/// One line of the study's table.
struct Mark {
  std::string what;
  std::string value;    // "97.6 % of 212"
  std::string pass;     // ">= 95.0 %"
  bool reached = true;  // the value is on the right side of the mark
  bool passed = true;   // it is, or misses the mark by no more than the allowance
};

/// `granted`: how many standard errors a value may miss its mark by, because a finite number of
/// cases scatters. The allowance shrinks as the number of cases grows.
std::vector<Mark> marks_of(const std::vector<Score>& scores, double granted);

/// As Markdown. The last column says "passed", "missed, within the allowance" or "missed".
std::string table_of(const std::vector<Mark>& marks);

/// One case in one line, for finding out what went wrong.
std::string line_of(int number, const Score& score);

}  // namespace plumb::tests
