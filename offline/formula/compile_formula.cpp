// SPDX-License-Identifier: Apache-2.0
#include "formula/compile_formula.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "formula/degree.hpp"
#include "formula/expression.hpp"
#include "formula/target_text.hpp"
#include "plumb/format/formula.hpp"

namespace plumb::offline {
namespace {

using format::FormulaOp;
using Kind = FormulaProblem::Kind;

constexpr std::uint8_t kRobot = 0, kEnvironment = 1;
constexpr std::size_t kMostSensors = 4;  // besides direction, travel, payload and time

void check_used(const std::vector<ParameterText>& parameters, const FormulaText& text,
                const Expression& expression, FormulaProblems& problems) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& name = parameters[i].name;
    if (name.empty()) continue;
    const bool used =
        std::any_of(expression.nodes.begin(), expression.nodes.end(), [&](const auto& node) {
          return node.op == FormulaOp::kParameter &&
                 parameters[static_cast<std::size_t>(node.operand)].name == name;
        });
    if (used) continue;
    problems.push_back({.kind = Kind::kParameter,
                        .field = FormulaProblem::Field::kParameter,
                        .parameter = i,
                        .at = text.parameters[i].find(name),
                        .length = name.size(),
                        .message = fmt::format("the expression does not use '{}'", name),
                        .label = "declared here",
                        .help = "delete it, or use it in the expression"});
  }
}

void check_result(const Expression& expression, const FormulaText& text, const TargetText& target,
                  FormulaProblems& problems) {
  const ExpressionNode& root = expression.nodes.back();
  const Dimension wanted = target.is_length ? kLength : kNumberOnly;
  if (!root.dimension || *root.dimension == wanted) return;
  std::string factor = text_of(wanted / *root.dimension);
  if (!target.is_length && factor.starts_with('1')) factor.replace(0, 1, "rad");
  problems.push_back(
      {.kind = Kind::kUnit,
       .at = root.first,
       .length = root.last - root.first,
       .message = fmt::format("the expression is in {}, but {} is in {}", text_of(*root.dimension),
                              text.target, target.is_length ? "m" : "rad"),
       .label = "wrong unit",
       .help = fmt::format("multiply it by a parameter in [{}]", factor)});
}

/// Reports variables that the cycle does not know in a formula whose domain is evaluated in the
/// cycle.
void check_domain(const Expression& expression, std::uint8_t domain, FormulaProblems& problems) {
  if (domain != kRobot && domain != kEnvironment) return;
  for (const auto& node : expression.nodes)
    if (node.op == FormulaOp::kMove || node.op == FormulaOp::kRow)
      problems.push_back({.kind = Kind::kDomain,
                          .at = node.at,
                          .length = node.length,
                          .message = "this is not known in the robot's cycle",
                          .label = "of the measurement only",
                          .help = node.op == FormulaOp::kMove ? "domain = \"procedure\""
                                                              : "domain = \"measurement\""});
}

/// The formula on one line, without the line breaks of the file.
std::string shown(const FormulaText& text) {
  std::string out = text.target + " = " + text.expression;
  for (char& c : out)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return out;
}

void check_size(const EmittedCode& code, const FormulaText& text, std::size_t parameters,
                FormulaProblems& problems) {
  const auto too_long = [&](const char* what, std::size_t has, int most) {
    if (has <= static_cast<std::size_t>(most)) return;
    problems.push_back(
        {.kind = Kind::kTooLong,
         .at = 0,
         .length = std::max<std::size_t>(1, text.expression.size()),
         .message = fmt::format("the formula has {} {}, at most {} fit", has, what, most),
         .label = "too long for the cycle",
         .help = "split it into two formulas with one target"});
  };
  too_long("operations", code.code.size(), format::kMaxFormulaCode);
  too_long("numbers waiting at once", static_cast<std::size_t>(code.depth),
           format::kMaxFormulaDepth);
  too_long("different numbers", code.literals.size(), format::kMaxFormulaLiterals);
  too_long("parameters", parameters, format::kMaxFormulaParameters);
  too_long("characters", shown(text).size(), format::kMaxFormulaText);
}

void check_sensors(const Expression& expression, const FormulaText& text,
                   FormulaProblems& problems) {
  if (expression.sensors.size() <= kMostSensors) return;
  problems.push_back({.kind = Kind::kTooLong,
                      .at = 0,
                      .length = std::max<std::size_t>(1, text.expression.size()),
                      .message = fmt::format("the formula reads {} temperatures, at most {} fit",
                                             expression.sensors.size(), kMostSensors),
                      .label = "too many",
                      .help = "split it into two formulas with one target"});
}

void add_parameters(const std::vector<ParameterText>& parameters, format::Formula& out) {
  for (const auto& p : parameters)
    out.parameters.push_back({p.name, p.unit.si, p.typical, p.start.value_or(0.0)});
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (!parameters[i].start && degree_of(out, static_cast<int>(i)) == Degree::kCurved)
      out.parameters[i].start = parameters[i].typical;
}

}  // namespace

bool CompiledFormula::reads(FormulaOp op) const {
  return std::any_of(formula.code.begin(), formula.code.end(),
                     [op](auto code) { return format::operation(code) == op; });
}

std::vector<std::uint8_t> CompiledFormula::joints_read(FormulaOp op) const {
  std::vector<std::uint8_t> out;
  for (const auto code : formula.code)
    if (format::operation(code) == op)
      out.push_back(static_cast<std::uint8_t>(format::operand(code)));
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

const std::vector<std::string>& formula_domains() {
  static const std::vector<std::string> all{"robot", "environment", "procedure", "measurement"};
  return all;
}

std::string formula_label(const FormulaText& text) {
  if (!text.name.empty()) return text.name;
  std::string out = text.target;
  std::replace(out.begin(), out.end(), '.', '_');
  return out;
}

CompiledFormula compile_formula(const FormulaText& text, const FormulaArm& arm,
                                FormulaProblems& problems) {
  const std::size_t before = problems.size();
  CompiledFormula out;
  const auto target = parse_target(text.target, arm, problems);
  const auto parameters = parse_parameters(text.parameters, problems);
  Expression expression = parse_expression(text.expression, parameters, arm, problems);
  const auto& domains = formula_domains();
  const auto domain = std::find(domains.begin(), domains.end(), text.domain) - domains.begin();
  if (!expression.complete) return out;
  check_units(expression, problems);
  check_used(parameters, text, expression, problems);
  check_domain(expression, static_cast<std::uint8_t>(domain), problems);
  if (target) check_result(expression, text, *target, problems);
  EmittedCode code = emit(expression);
  check_size(code, text, parameters.size(), problems);
  check_sensors(expression, text, problems);
  if (problems.size() > before) return out;
  out.formula = {.name = formula_label(text),
                 .target = target->target,
                 .joint = target->joint,
                 .component = target->component,
                 .domain = static_cast<std::uint8_t>(domain),
                 .expression = shown(text),
                 .code = std::move(code.code),
                 .literals = std::move(code.literals),
                 .parameters = {}};
  add_parameters(parameters, out.formula);
  out.sensors = std::move(expression.sensors);
  return out;
}

}  // namespace plumb::offline
