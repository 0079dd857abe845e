// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/blind/score.hpp"

namespace plumb::tests {

/// One line of the study's table.
struct Mark {
  std::string what;
  std::string value;  // "97.6 % of 212"
  std::string pass;   // "at least 95 %"
  bool passed = true;
};

/// `granted`: how many standard errors a share may miss its mark by: a slice has few cases, and as
/// the study grows they vanish.
std::vector<Mark> marks_of(const std::vector<Score>& scores, double granted);

/// As Markdown.
std::string table_of(const std::vector<Mark>& marks);

/// One case in one line, for finding out what went wrong.
std::string line_of(int number, const Score& score);

}  // namespace plumb::tests
