// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "diagnose/regressor.hpp"

namespace plumb::offline {

/// A number that formulas can read, at every pose: "q4" [rad], "dir5" [1], "tau4" [N m].
struct FormulaInput {
  std::string name, unit;
  Eigen::ArrayXd value;  // (poses,)
};

/// A function of the inputs as a formula writes it, without its factor, and its values.
struct FormulaTerm {
  enum class Shape { kWave, kPower, kOther };
  std::string text;   // "sin(2*q4)*cos(q6)"
  std::string unit;   // of its value: "1", "N m"
  std::string first;  // the input that it is drawn over
  Shape shape = Shape::kOther;
  Eigen::ArrayXd value;  // (poses,)
};

/// The inputs of a pattern that formulas can read: what it depends on, the directions of approach
/// and the loads of the joints of these and of the one that errs. Empty: none of them can be read.
std::vector<FormulaInput> formula_inputs(const WhitenedFit& whitened, const Pattern& pattern);

/// Terms of a law in these inputs: sines and cosines, their products for two joints, powers, each
/// with and without the direction of approach, loads, and what slow readings need. The same list
/// for the same names, whatever their values are.
std::vector<FormulaTerm> formula_terms(const Pattern& pattern,
                                       const std::vector<FormulaInput>& inputs,
                                       const std::vector<FormulaInput>& over);

}  // namespace plumb::offline
