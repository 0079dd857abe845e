// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "figures/run_results.hpp"

namespace plumb::offline::figures {

/// A formula of the user's own in a run, over one of the inputs that it reads, and what each pose
/// says of it. r = m.e / m.m with m the motion of the measured point per unit of what the formula
/// moves [m/rad] or [m/m]: by how much more that would have to move to explain the error e.
struct FormulaPoints {
  std::string formula;            // "dq3 = k*tau3", as it was written
  std::string input, input_unit;  // "torque of gravity on J3", "N m"
  std::size_t inputs = 0;         // how many it reads
  bool turns = true;              // what it moves turns [rad]; false: it shifts [m]
  struct Pose {
    int row = 0;
    double input = 0.0;   // in `input_unit`
    double value = 0.0;   // r and what the formula adds to it: what the formula has to explain
    double law = 0.0;     // what the formula adds
    double sigma = 0.0;   // 1 sigma of that, by the covariance of the run
    double weight = 0.0;  // m.m: large where the pose shows the motion well
    bool held = false;
  };
  std::vector<Pose> poses = {};  // by input
};

/// The points of every formula of the run, in the order of its effects. If a formula reads several
/// inputs, the one is taken with which its value correlates most. Outliers are left out, repeats in
/// a row averaged. Cost: poses * formulas * (inputs + parameters).
std::vector<FormulaPoints> formula_points(const RunResults& results);

/// Whether the run has a formula.
bool has_formula(const RunResults& results);

}  // namespace plumb::offline::figures
