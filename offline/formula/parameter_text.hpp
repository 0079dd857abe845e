// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formula/formula_problem.hpp"
#include "formula/unit_text.hpp"

namespace plumb::offline {

/// "k [rad/(N m)] ~ 1e-6 = 2e-6": name, unit, typical size and, if wanted, where the fit begins.
/// SI.
struct ParameterText {
  std::string name;
  WrittenUnit unit;
  double typical = 1.0;
  std::optional<double> start;
  bool sound = false;  // else it was reported, and its unit may be any
};

std::vector<ParameterText> parse_parameters(const std::vector<std::string>& texts,
                                            FormulaProblems& problems);

}  // namespace plumb::offline
