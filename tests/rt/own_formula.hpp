// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/formula.hpp"

namespace plumb::tests {

/// dq2 = k * tau2 * (1 + c*abs(tau2)) + sin(log(q1)), which has no value at half of the poses.
inline format::Effect own_formula() {
  using format::FormulaOp;
  using format::instruction;
  format::Effect out;
  out.name = "formula";
  out.parameters = {1e-7, 1e-3};
  out.formula.joint = 1;
  out.formula.literals = {1.0};
  out.formula.parameters = {{"k", "rad/(N m)", 1e-7, 0.0}, {"c", "1/(N m)", 1e-3, 0.0}};
  out.formula.code = {instruction(FormulaOp::kParameter, 0), instruction(FormulaOp::kTorque, 1),
                      instruction(FormulaOp::kMultiply),     instruction(FormulaOp::kLiteral, 0),
                      instruction(FormulaOp::kParameter, 1), instruction(FormulaOp::kTorque, 1),
                      instruction(FormulaOp::kAbs),          instruction(FormulaOp::kMultiply),
                      instruction(FormulaOp::kAdd),          instruction(FormulaOp::kMultiply),
                      instruction(FormulaOp::kPosition, 0),  instruction(FormulaOp::kLog),
                      instruction(FormulaOp::kSin),          instruction(FormulaOp::kAdd)};
  return out;
}

}  // namespace plumb::tests
