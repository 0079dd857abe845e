// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "plumb/format/limits.hpp"
#include "plumb/format/model.hpp"

/// The check that makes a formula's stack code safe to run without further checks.
namespace plumb::format {

constexpr std::uint16_t instruction(FormulaOp op, unsigned operand = 0) {
  return static_cast<std::uint16_t>(static_cast<unsigned>(op) | operand << 8U);
}
constexpr FormulaOp operation(std::uint16_t code) { return static_cast<FormulaOp>(code & 0xFFU); }
constexpr unsigned operand(std::uint16_t code) { return code >> 8U; }

constexpr bool is_operation(std::uint16_t code) {
  return (code & 0xFFU) <= static_cast<unsigned>(FormulaOp::kClamp);
}

/// How many numbers an operation takes from the stack. Every operation pushes one result.
constexpr int taken(FormulaOp op) {
  if (op == FormulaOp::kClamp) return 3;
  if (op >= FormulaOp::kAdd) return 2;
  return op >= FormulaOp::kNegate ? 1 : 0;
}

enum class FormulaFault : std::uint8_t {
  kNone,
  kMissing,    // an effect 'formula' has no formula, or another effect has one
  kTooLong,    // the code, literals, parameters or text exceed their limits
  kOperation,  // an operation is unknown
  kOperand,    // a literal, parameter, joint or sensor does not exist
  kStack,      // the stack underflows, grows too high, or does not end with one number
  kTarget,     // the joint, component or frame to move does not exist
  kNumbers     // a number is not finite, or the number of parameters is wrong
};

/// The number of values that the operand of an instruction may take, from 0 on.
inline std::size_t choices(FormulaOp op, const Effect& effect, std::size_t joints) noexcept {
  switch (op) {
    case FormulaOp::kLiteral:
      return effect.formula.literals.size();
    case FormulaOp::kParameter:
      return effect.parameters.size();
    case FormulaOp::kPosition:
    case FormulaOp::kTorque:
    case FormulaOp::kDirection:
    case FormulaOp::kTravel:
    case FormulaOp::kMove:
      return joints;
    case FormulaOp::kTemperature:
      return static_cast<std::size_t>(
          std::count_if(effect.context.begin(), effect.context.end(),
                        [](const auto& n) { return n.input == ContextInput::kTemperature; }));
    case FormulaOp::kTip:
      return 3;
    default:
      return 1;
  }
}

/// Checks that the code stays inside its stack and its tables. There are no jumps, so code that
/// passes ends and leaves one number. Cost: one pass over the code.
inline FormulaFault find_formula_fault(const Effect& effect, std::size_t joints) noexcept {
  const Formula& f = effect.formula;
  const bool wanted = effect.name == "formula";
  if (wanted ? f.code.empty() : f != Formula{}) return FormulaFault::kMissing;
  if (!wanted) return FormulaFault::kNone;
  if (f.code.size() > kMaxFormulaCode || f.literals.size() > kMaxFormulaLiterals ||
      f.parameters.size() > kMaxFormulaParameters || f.expression.size() > kMaxFormulaText)
    return FormulaFault::kTooLong;
  if (f.parameters.size() != effect.parameters.size()) return FormulaFault::kNumbers;
  for (double x : f.literals)
    if (!std::isfinite(x)) return FormulaFault::kNumbers;
  for (const auto& p : f.parameters)
    if (!std::isfinite(p.start) || !(p.typical > 0.0) || !std::isfinite(p.typical))
      return FormulaFault::kNumbers;
  const bool of_tip = f.target == FormulaTarget::kTip;
  if (f.target > FormulaTarget::kTip || f.joint >= joints || f.component > (of_tip ? 2 : 5) ||
      f.domain > 3)
    return FormulaFault::kTarget;
  int height = 0;
  for (const std::uint16_t code : f.code) {
    if (!is_operation(code)) return FormulaFault::kOperation;
    const FormulaOp op = operation(code);
    if (operand(code) >= choices(op, effect, joints)) return FormulaFault::kOperand;
    height -= taken(op);
    if (height < 0 || ++height > kMaxFormulaDepth) return FormulaFault::kStack;
  }
  return height == 1 ? FormulaFault::kNone : FormulaFault::kStack;
}

/// Whether the formula reads what is known only of measured poses: a joint's last move relative to
/// the others, or the row. No model file contains such a formula.
inline bool reads_measurement(const Formula& f) noexcept {
  return std::any_of(f.code.begin(), f.code.end(), [](std::uint16_t code) {
    return operation(code) == FormulaOp::kMove || operation(code) == FormulaOp::kRow;
  });
}

}  // namespace plumb::format
