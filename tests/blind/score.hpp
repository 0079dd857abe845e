// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/diagnosis.hpp"
#include "tests/blind/formula_score.hpp"
#include "tests/blind/hidden_case.hpp"

namespace plumb::tests {

/// What a diagnosis claims with confidence, and whether it is so.
struct Claims {
  bool alarm = false;        // it named something, for certain or as one of several, or added it
  double lead = 0.0;         // nats from the first candidate to the next
  bool first_right = false;  // its first candidate is of a class that is hidden
  bool either = false;       // it said "A or B"
  bool either_right = false;
  bool slow_motion = false;     // it said that a step may be a slow motion
  bool turned_gravity = false;  // it said for certain that gravity acts in another direction
  bool first_doubtful = false;  // it said that its first candidate may be a part of another cause
  int unrelated_certain = 0;    // of the unrelated ones, those of which it did not say so
  int doubtful_right = 0;       // added and hidden, and it said so
  int unrelated = 0;            // added, but neither it nor what it may be instead is hidden
  bool fall_counts = false;     // new poses can tell by how much the error falls with the first
  double fall = 0.0, fall_se = 0.0;  // claimed, as shares of the error
  double true_fall = 0.0;            // of inconvenient arms
};

/// How one diagnosis did against the truth. Errors in sigma.
struct Score {
  HiddenCase drawn;
  bool made = false;  // the arm could be simulated and calibrated
  std::string why_not;
  offline::Finding finding{}, finding_after{};
  bool class_first = false, joint_first = false;  // of the largest hidden effect
  std::vector<bool> recalled;                     // of each hidden effect
  int added = 0;                                  // effects
  int extra = 0;                                  // added, but nothing like it is hidden
  bool inputs_right = false;                      // of an unknown effect
  bool unknown_said = false;
  bool step_found = false;           // pose within 1, shift within 10 %
  double before = 0.0, after = 0.0;  // true error, per-axis RMS in sigma
  double with_tree = -1.0;           // the same with a tree on the rest; -1: not tried
  double held_over_floor = 0.0;      // held-out RMS over noise floor
  double held_over_true = 0.0;       // held-out RMS over what fresh noisy poses would show
  std::optional<Claims> claims;
  std::optional<FormulaScore> formula;  // of the study of formulas
  double seconds = 0.0;
  std::string said;  // first candidate, what was added
};

/// Simulates, diagnoses with `apply`, and only then looks at the truth.
Score run_case(const HiddenCase& drawn);

}  // namespace plumb::tests
