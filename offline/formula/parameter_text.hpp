// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formula/formula_problem.hpp"
#include "formula/unit_text.hpp"

namespace plumb::offline {

/// A parameter as text, for example "k [rad/(N m)] ~ 1e-6 = 2e-6": name, unit, typical size and
/// optionally the start value of the fit. Values in SI units.
struct ParameterText {
  std::string name;
  WrittenUnit unit;
  double typical = 1.0;
  std::optional<double> start;
  bool sound = false;  // false after a reported problem; the unit then is arbitrary
};

std::vector<ParameterText> parse_parameters(const std::vector<std::string>& texts,
                                            FormulaProblems& problems);

}  // namespace plumb::offline
