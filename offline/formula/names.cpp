// SPDX-License-Identifier: Apache-2.0
#include "formula/names.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace plumb::offline {
namespace {

using format::FormulaOp;

struct OfJoint {
  const char* name;
  FormulaOp op;
};
constexpr OfJoint kOfJoints[] = {{"q", FormulaOp::kPosition},
                                 {"tau", FormulaOp::kTorque},
                                 {"dir", FormulaOp::kDirection},
                                 {"travel", FormulaOp::kTravel},
                                 {"u", FormulaOp::kMove}};

struct OfArm {
  const char* name;
  FormulaOp op;
  int operand;
  Dimension dimension;
};
constexpr OfArm kOfArm[] = {
    {"t", FormulaOp::kTime, 0, kTime},  {"payload", FormulaOp::kPayload, 0, kMass},
    {"x", FormulaOp::kTip, 0, kLength}, {"y", FormulaOp::kTip, 1, kLength},
    {"z", FormulaOp::kTip, 2, kLength}, {"row", FormulaOp::kRow, 0, kNumberOnly}};

constexpr Function kFunctions[] = {
    {"sin", FormulaOp::kSin, 1},   {"cos", FormulaOp::kCos, 1},   {"exp", FormulaOp::kExp, 1},
    {"log", FormulaOp::kLog, 1},   {"sqrt", FormulaOp::kSqrt, 1}, {"abs", FormulaOp::kAbs, 1},
    {"tanh", FormulaOp::kTanh, 1}, {"sign", FormulaOp::kSign, 1}, {"step", FormulaOp::kStep, 1},
    {"min", FormulaOp::kMin, 2},   {"max", FormulaOp::kMax, 2},   {"clamp", FormulaOp::kClamp, 3}};

/// The number that follows the prefix, counted from 1; 0 if there is none.
int number_behind(const std::string& name, const std::string& prefix) {
  if (!name.starts_with(prefix)) return 0;
  const char* first = name.data() + prefix.size();
  const char* last = name.data() + name.size();
  int out = 0;
  const auto [end, error] = std::from_chars(first, last, out);
  if (error != std::errc{} || end != last || *first == '0') return 0;
  return std::max(0, out);
}

Dimension dimension_of(FormulaOp op, bool slides) {
  switch (op) {
    case FormulaOp::kPosition:
    case FormulaOp::kTravel:
      return slides ? kLength : kNumberOnly;
    case FormulaOp::kTorque:
      return slides ? kForce : kTorque;
    default:
      return kNumberOnly;
  }
}

}  // namespace

std::optional<Variable> find_variable(const std::string& name, const FormulaArm& arm) {
  for (const auto& [own, op, operand, dimension] : kOfArm)
    if (name == own) return Variable{op, operand, dimension};
  for (const auto& [prefix, op] : kOfJoints) {
    const int joint = number_behind(name, prefix);
    if (joint < 1 || joint > arm.joints()) continue;
    return Variable{op, joint - 1,
                    dimension_of(op, arm.slides[static_cast<std::size_t>(joint - 1)])};
  }
  if (name == "temp" || (name.starts_with("temp_") && name.size() > 5))
    return Variable{FormulaOp::kTemperature, 0, kTemperature, name};
  return std::nullopt;
}

const Function* find_function(const std::string& name) {
  for (const auto& function : kFunctions)
    if (name == function.name) return &function;
  return nullptr;
}

std::vector<std::string> formula_names(const FormulaArm& arm) {
  std::vector<std::string> out{"pi", "temp"};
  for (const auto& own : kOfArm) out.emplace_back(own.name);
  for (const auto& own : kOfJoints)
    for (int j = 1; j <= arm.joints(); ++j) out.push_back(own.name + std::to_string(j));
  for (const auto& function : kFunctions) out.emplace_back(function.name);
  return out;
}

bool is_reserved(const std::string& name) {
  const FormulaArm largest{std::vector<bool>(format::kMaxJoints, false)};
  return name == "pi" || find_variable(name, largest) || find_function(name) != nullptr;
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '_';
         });
}

}  // namespace plumb::offline
