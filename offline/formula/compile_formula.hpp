// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "formula/formula_problem.hpp"
#include "formula/names.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// A formula as it is written in the cell file.
struct FormulaText {
  std::string name;  // if empty, the formula is named after its target
  std::string target;
  std::string expression;
  std::vector<std::string> parameters;
  std::string domain = "robot";
};

/// A formula, ready to be bound to measurements.
struct CompiledFormula {
  format::Formula formula;
  std::vector<std::string> sensors;  // temperatures in the order of its code
  bool reads(format::FormulaOp op) const;
  std::vector<std::uint8_t> joints_read(format::FormulaOp op) const;  // sorted, each once
};

/// Translates a formula and checks its names, units and sizes against the arm. The result is valid
/// only if nothing was added to `problems`.
CompiledFormula compile_formula(const FormulaText& text, const FormulaArm& arm,
                                FormulaProblems& problems);

/// The name of a formula: its own, such as "motor_heat", or one after its target, such as "dq2" or
/// "post4_dz".
std::string formula_label(const FormulaText& text);

const std::vector<std::string>& formula_domains();

}  // namespace plumb::offline
