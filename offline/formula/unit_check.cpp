// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "formula/expression.hpp"
#include "plumb/runtime/detail/formula_code.hpp"

namespace plumb::offline {
namespace {

using format::FormulaOp;
using Unit = std::optional<Dimension>;

class UnitCheck {
 public:
  UnitCheck(std::vector<ExpressionNode>& nodes, FormulaProblems& problems)
      : nodes_(nodes), problems_(problems) {}

  void check(ExpressionNode& node) {
    node_ = &node;
    if (node.inner.empty()) {
      if (node.is_number) node.constant = node.value;
      return;
    }
    node.dimension = unit();
    fold();
  }

 private:
  const ExpressionNode& inner(std::size_t i) const {
    return nodes_[static_cast<std::size_t>(node_->inner[i])];
  }

  void report(FormulaProblem::Kind kind, const ExpressionNode& where, std::string message,
              std::string label, std::string help) {
    problems_.push_back({.kind = kind,
                         .at = where.at,
                         .length = where.length,
                         .message = std::move(message),
                         .label = std::move(label),
                         .help = std::move(help)});
  }

  /// Checks that all operands have the same unit, which is that of the result.
  Unit alike(const char* what) {
    Unit out;
    for (std::size_t i = 0; i < node_->inner.size(); ++i) {
      const Unit& next = inner(i).dimension;
      if (!next) continue;
      if (out && *out != *next) {
        report(FormulaProblem::Kind::kUnit, *node_,
               fmt::format("{} of {} and {}", what, text_of(*out), text_of(*next)), "units differ",
               "give a number its unit, as in 50 [N m]");
        return std::nullopt;
      }
      out = next;
    }
    return out;
  }

  Unit number_only(const char* what) {
    const Unit& given = inner(0).dimension;
    if (given && !given->none())
      report(FormulaProblem::Kind::kUnit, *node_,
             fmt::format("{} of a quantity in {}", what, text_of(*given)), "wants a plain number",
             fmt::format("divide it by a size, as in {}(... / 1 [{}])", what, text_of(*given)));
    return kNumberOnly;
  }

  Unit power() {
    const Unit &base = inner(0).dimension, &exponent = inner(1).dimension;
    if (exponent && !exponent->none()) {
      report(FormulaProblem::Kind::kUnit, *node_,
             fmt::format("the exponent is in {}", text_of(*exponent)), "wants a plain number",
             "divide it by a size with that unit");
      return std::nullopt;
    }
    if (!base || base->none()) return base;
    if (const auto constant = inner(1).constant) return raised(*base, *constant);
    report(FormulaProblem::Kind::kUnit, *node_,
           fmt::format("a quantity in {} to a power that varies", text_of(*base)), "has no unit",
           "divide the quantity by a size first, or write the power as a number");
    return std::nullopt;
  }

  Unit unit() {
    const auto product = [&](bool over) -> Unit {
      const Unit &a = inner(0).dimension, &b = inner(1).dimension;
      if (!a || !b) return std::nullopt;
      return over ? *a / *b : *a * *b;
    };
    switch (node_->op) {
      case FormulaOp::kNegate:
      case FormulaOp::kAbs:
        return inner(0).dimension;
      case FormulaOp::kSign:
      case FormulaOp::kStep:
        return kNumberOnly;
      case FormulaOp::kSqrt:
        return inner(0).dimension ? Unit(raised(*inner(0).dimension, 0.5)) : std::nullopt;
      case FormulaOp::kSin:
        return number_only("sin");
      case FormulaOp::kCos:
        return number_only("cos");
      case FormulaOp::kExp:
        return number_only("exp");
      case FormulaOp::kLog:
        return number_only("log");
      case FormulaOp::kTanh:
        return number_only("tanh");
      case FormulaOp::kAdd:
        return alike("a sum");
      case FormulaOp::kSubtract:
        return alike("a difference");
      case FormulaOp::kMultiply:
        return product(false);
      case FormulaOp::kDivide:
        return product(true);
      case FormulaOp::kPower:
        return power();
      case FormulaOp::kMin:
      case FormulaOp::kMax:
        return alike("the smaller or larger");
      default:  // kClamp
        return alike("clamp");
    }
  }

  /// Computes the value of a constant operation with the functions of the cycle.
  void fold() {
    ExpressionNode& node = *node_;
    if (node.op == FormulaOp::kDivide && inner(1).constant == 0.0) {
      report(FormulaProblem::Kind::kNoNumber, node, "this divides by zero, whatever the pose",
             "the divisor is 0", "delete the division, or make its divisor a parameter");
      return;
    }
    for (int i : node.inner)
      if (!nodes_[static_cast<std::size_t>(i)].constant) return;
    double value = *inner(0).constant;
    if (node.inner.size() == 1)
      value = formula::on_one(node.op, value);
    else if (node.inner.size() == 2)
      value = formula::on_two(node.op, value, *inner(1).constant);
    else
      value = formula::lesser(formula::greater(value, *inner(1).constant), *inner(2).constant);
    if (std::isfinite(value))
      node.constant = value;
    else
      report(FormulaProblem::Kind::kNoNumber, node, "this is no number, whatever the pose",
             "infinite or undefined", "log wants more than 0, sqrt 0 or more");
  }

  std::vector<ExpressionNode>& nodes_;
  FormulaProblems& problems_;
  ExpressionNode* node_ = nullptr;
};

}  // namespace

void check_units(Expression& expression, FormulaProblems& problems) {
  UnitCheck check(expression.nodes, problems);
  for (auto& node : expression.nodes) check.check(node);
}

}  // namespace plumb::offline
