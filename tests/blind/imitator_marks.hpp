// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/blind/marks.hpp"

namespace plumb::tests {

/// What a diagnosis came to in a case of the study of imitators.
enum class Outcome {
  kRight,  // it named the cause, alone or as one of several, or said that it is unknown and on what
           // it depends
  kVague,  // it said that it cannot tell, or found nothing, or unknown structure of other inputs
  kWrong   // it named another cause for certain, only other ones as possible, or added another
};
Outcome outcome_of(const Score& score);

/// The marks of the study of imitators. `granted`: see marks_of.
std::vector<Mark> imitator_marks_of(const std::vector<Score>& scores, double granted);

/// What became of each kind, as Markdown.
std::string imitator_table_of(const std::vector<Score>& scores);

}  // namespace plumb::tests
