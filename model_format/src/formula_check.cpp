// SPDX-License-Identifier: Apache-2.0
#include "formula_check.hpp"

#include "plumb/format/formula.hpp"
#include "text_check.hpp"

namespace plumb::format::internal {
namespace {

const char* words(FormulaFault fault) {
  switch (fault) {
    case FormulaFault::kMissing:
      return "is no formula and has one, or is one and has none";
    case FormulaFault::kTooLong:
      return "is longer than a formula may be";
    case FormulaFault::kOperation:
      return "has an unknown operation";
    case FormulaFault::kOperand:
      return "reads what is not there";
    case FormulaFault::kStack:
      return "has code that does not end with one number";
    case FormulaFault::kTarget:
      return "moves what is not there";
    default:
      return "has numbers that do not fit";
  }
}

}  // namespace

std::optional<std::string> unsound_formula(const Effect& effect, std::size_t joints) {
  const std::string what = "effect '" + effect.name + "' ";
  const FormulaFault fault = find_formula_fault(effect, joints);
  if (fault != FormulaFault::kNone) return what + words(fault);
  const Formula& f = effect.formula;
  if (auto finding = unprintable(f.name, what + "name")) return finding;
  if (auto finding = unprintable(f.expression, what + "expression", kMaxFormulaText))
    return finding;
  for (const auto& p : f.parameters)
    for (const auto* text : {&p.name, &p.unit})
      if (auto finding = unprintable(*text, what + "parameter")) return finding;
  return std::nullopt;
}

}  // namespace plumb::format::internal
