// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/formula.hpp"
#include "plumb/runtime/detail/elementary.hpp"
#include "plumb/runtime/detail/plain.hpp"

/// Runs the stack code of a formula. It is a template on the type of number, so that the fit (with
/// numbers that carry derivatives) and the cycle (with double) run the same code.
namespace plumb::formula {

using format::FormulaOp;

/// True if x is neither infinite nor NaN.
inline bool is_number(double x) noexcept { return x - x == 0.0; }

template <class S>
S on_one(FormulaOp op, const S& a) noexcept {
  using portable::exp;
  using portable::log;
  using portable::sin_cos;
  using portable::sqrt;
  using portable::tanh;
  const double v = plain(a);
  switch (op) {
    case FormulaOp::kNegate:
      return -a;
    case FormulaOp::kSin:
      return sin_cos(a).sin;
    case FormulaOp::kCos:
      return sin_cos(a).cos;
    case FormulaOp::kExp:
      return exp(a);
    case FormulaOp::kLog:
      return log(a);
    case FormulaOp::kSqrt:
      return sqrt(a);
    case FormulaOp::kAbs:
      return v < 0.0 ? -a : a;
    case FormulaOp::kTanh:
      return tanh(a);
    case FormulaOp::kSign:
      return v != v ? a : S(v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0);
    default:  // kStep
      return v != v ? a : S(v > 0.0 ? 1.0 : 0.0);
  }
}

/// The smaller of two numbers; NaN if one of them is NaN.
template <class S>
S lesser(const S& a, const S& b) noexcept {
  return plain(a) != plain(a) || plain(a) <= plain(b) ? a : b;
}
/// The larger of two numbers; NaN if one of them is NaN.
template <class S>
S greater(const S& a, const S& b) noexcept {
  return plain(a) != plain(a) || plain(a) >= plain(b) ? a : b;
}

template <class S>
S on_two(FormulaOp op, const S& a, const S& b) noexcept {
  using portable::pow;
  switch (op) {
    case FormulaOp::kAdd:
      return a + b;
    case FormulaOp::kSubtract:
      return a - b;
    case FormulaOp::kMultiply:
      return a * b;
    case FormulaOp::kDivide:
      return a / b;
    case FormulaOp::kPower:
      return pow(a, b);
    case FormulaOp::kMin:
      return lesser(a, b);
    default:  // kMax
      return greater(a, b);
  }
}

/// Value of the formula. read(op, operand) returns the inputs other than parameters and literals.
/// Precondition: find_formula_fault finds no fault. Cost: at most kMaxFormulaCode operations, the
/// same ones whatever the numbers are. No heap; any thread.
template <class S, class Read>
S evaluate(const format::Formula& formula, std::span<const S> theta, const Read& read) noexcept {
  std::array<S, format::kMaxFormulaDepth> stack;
  std::size_t height = 0;
  for (const std::uint16_t code : formula.code) {
    const FormulaOp op = format::operation(code);
    const std::size_t which = format::operand(code);
    switch (format::taken(op)) {
      case 0:
        stack[height++] = op == FormulaOp::kParameter ? theta[which]
                          : op == FormulaOp::kLiteral ? S(formula.literals[which])
                                                      : S(read(op, which));
        break;
      case 1:
        stack[height - 1] = on_one(op, stack[height - 1]);
        break;
      case 2:
        --height;
        stack[height - 1] = on_two(op, stack[height - 1], stack[height]);
        break;
      default:  // clamp
        height -= 2;
        stack[height - 1] = lesser(greater(stack[height - 1], stack[height]), stack[height + 1]);
    }
  }
  return stack[0];
}

}  // namespace plumb::formula
