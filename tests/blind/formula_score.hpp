// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "diagnose/diagnosis.hpp"
#include "tests/blind/hidden_case.hpp"
#include "tests/blind/seen.hpp"

namespace plumb::tests {

/// How the formulas that a diagnosis offers did against the truth.
struct FormulaScore {
  int offered = 0;
  bool variables_right = false;  // of the first: it moves the joint that errs, and reads its inputs
  double held_ratio = 0.0;       // held-out error with the first over that without it
  /// What a tracker would show on fresh poses with the first formula, over what it would show if
  /// nothing had been hidden in this arm and the model were fitted then: the true law's error.
  double over_true_law = 0.0;
  double before_over_true_law = 0.0;  // the same without any formula
  std::string law;                    // the first
};

FormulaScore formula_score(const HiddenCase& drawn, const offline::BlindCase& blind,
                           const Seen& seen, const offline::Diagnosis& d);

}  // namespace plumb::tests
