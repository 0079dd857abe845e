// SPDX-License-Identifier: Apache-2.0
#include "formula/degree.hpp"

#include <algorithm>

#include "plumb/format/formula.hpp"

namespace plumb::offline {
namespace {

using format::FormulaOp;

constexpr int kAll = -1;

Degree on_one(FormulaOp op, Degree a) {
  if (op == FormulaOp::kNegate) return a;
  return a == Degree::kNone ? Degree::kNone : Degree::kCurved;
}

Degree on_two(FormulaOp op, Degree a, Degree b) {
  switch (op) {
    case FormulaOp::kAdd:
    case FormulaOp::kSubtract:
      return std::max(a, b);
    case FormulaOp::kMultiply:
      if (a == Degree::kNone) return b;
      return b == Degree::kNone ? a : Degree::kCurved;
    case FormulaOp::kDivide:
      return b == Degree::kNone ? a : Degree::kCurved;
    default:
      return std::max(a, b) == Degree::kNone ? Degree::kNone : Degree::kCurved;
  }
}

Degree walked(const format::Formula& formula, int parameter) {
  std::vector<Degree> stack;
  for (const std::uint16_t code : formula.code) {
    const FormulaOp op = format::operation(code);
    const auto take = [&stack] {
      const Degree out = stack.back();
      stack.pop_back();
      return out;
    };
    switch (format::taken(op)) {
      case 0: {
        const bool counts =
            op == FormulaOp::kParameter &&
            (parameter == kAll || parameter == static_cast<int>(format::operand(code)));
        stack.push_back(counts ? Degree::kLinear : Degree::kNone);
        break;
      }
      case 1:
        stack.push_back(on_one(op, take()));
        break;
      case 2: {
        const Degree b = take(), a = take();
        stack.push_back(on_two(op, a, b));
        break;
      }
      default: {
        const Degree c = take(), b = take(), a = take();
        const Degree most = std::max({a, b, c});
        stack.push_back(most == Degree::kNone ? most : Degree::kCurved);
      }
    }
  }
  return stack.back();
}

}  // namespace

Degree degree_of(const format::Formula& formula, int parameter) {
  return walked(formula, parameter);
}
Degree degree_of(const format::Formula& formula) { return walked(formula, kAll); }

}  // namespace plumb::offline
