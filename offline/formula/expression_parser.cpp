// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "formula/expression.hpp"

namespace plumb::offline {
namespace {

using format::FormulaOp;

constexpr double kPi = 3.14159265358979323846;
constexpr int kDeepest = 64;  // nested parentheses, powers and signs

/// sum = product {(+|-) product};  product = signed {(*|/) signed};  signed = {-|+} power;
/// power = primary [^ signed];  primary = number [unit] | name | name(sum, ...) | (sum)
class ExpressionParser {
 public:
  ExpressionParser(const std::string& text, const std::vector<ParameterText>& parameters,
                   const FormulaArm& arm, FormulaProblems& problems)
      : parameters_(parameters), arm_(arm), problems_(problems) {
    const std::size_t before = problems.size();
    tokens_ = tokens_of(text, problems);
    if (problems.size() > before) stop_ = true;
  }

  Expression parse() {
    if (stop_) return std::move(out_);
    if (now().kind == Token::Kind::kEnd) fail("there is no expression", "k * tau2");
    if (!stop_) sum();
    if (!stop_ && now().kind != Token::Kind::kEnd) fail_here();
    out_.complete = !stop_;
    return std::move(out_);
  }

 private:
  const Token& now() const { return tokens_[next_]; }
  bool is(const char* sign) const { return now().kind == Token::Kind::kSign && now().text == sign; }
  bool take(const char* sign) {
    if (stop_ || !is(sign)) return false;
    ++next_;
    return true;
  }

  int fail(std::string message, std::string label) {
    if (!stop_)
      problems_.push_back({.at = now().at,
                           .length = std::max<std::size_t>(1, now().length),
                           .message = std::move(message),
                           .label = std::move(label),
                           .help = "signs are + - * / ^ ( ), as in: k * tau2 * (1 + c*abs(tau2))"});
    stop_ = true;
    return none();
  }
  int fail_here() {
    if (now().kind == Token::Kind::kEnd)
      return fail("the formula ends too early", "more is needed");
    if (now().kind == Token::Kind::kUnit) return fail("a unit follows a number only", "here");
    return fail(fmt::format("'{}' is not expected here", now().text), "here");
  }

  int add(ExpressionNode node) {
    for (int i : node.inner) {
      node.first = std::min(node.first, out_.nodes[static_cast<std::size_t>(i)].first);
      node.last = std::max(node.last, out_.nodes[static_cast<std::size_t>(i)].last);
    }
    out_.nodes.push_back(std::move(node));
    return static_cast<int>(out_.nodes.size()) - 1;
  }
  ExpressionNode at(const Token& token) const {
    ExpressionNode out;
    out.at = out.first = token.at;
    out.length = token.length;
    out.last = token.at + token.length;
    return out;
  }
  /// A node in place of text that could not be read. No code is made of an expression that contains
  /// it.
  int none() { return add(at(now())); }

  int binary(FormulaOp op, const Token& sign, int a, int b) {
    ExpressionNode node = at(sign);
    node.op = op;
    node.inner = {a, b};
    return add(std::move(node));
  }

  int sum() {
    int left = product();
    while (!stop_ && (is("+") || is("-"))) {
      const Token sign = now();
      ++next_;
      left =
          binary(sign.text == "+" ? FormulaOp::kAdd : FormulaOp::kSubtract, sign, left, product());
    }
    return left;
  }

  int product() {
    int left = signed_power();
    while (!stop_ && (is("*") || is("/"))) {
      const Token sign = now();
      ++next_;
      if (is("*")) return fail("'**' is not a sign here", "a power is written ^");
      left = binary(sign.text == "*" ? FormulaOp::kMultiply : FormulaOp::kDivide, sign, left,
                    signed_power());
    }
    return left;
  }

  int signed_power() {
    if (depth_ > kDeepest) return fail("too much stands inside each other", "here");
    ++depth_;
    int out = -1;
    const Token sign = now();
    if (take("-")) {
      ExpressionNode node = at(sign);
      node.op = FormulaOp::kNegate;
      node.inner = {signed_power()};
      out = add(std::move(node));
    } else if (take("+")) {
      out = signed_power();
    } else {
      out = power();
    }
    --depth_;
    return out;
  }

  int power() {
    const int base = primary();
    const Token sign = now();
    if (!take("^")) return base;
    return binary(FormulaOp::kPower, sign, base, signed_power());
  }

  int primary() {
    if (stop_) return none();
    const Token token = now();
    if (token.kind == Token::Kind::kNumber) return number();
    if (token.kind == Token::Kind::kName) return name();
    if (!take("(")) return fail_here();
    const int inside = sum();
    if (!stop_ && !take(")")) return fail("a ')' is missing", "before this");
    return inside;
  }

  int number() {
    ExpressionNode node = at(now());
    node.value = now().value;
    node.is_number = true;
    ++next_;
    // The number 0 has any unit.
    if (node.value != 0.0) node.dimension = kNumberOnly;
    if (now().kind == Token::Kind::kUnit) read_unit(node);
    return add(std::move(node));
  }

  void read_unit(ExpressionNode& node) {
    const Token token = now();
    ++next_;
    node.last = token.at + token.length;
    const auto read = parse_unit(token.text);
    if (const auto* unit = std::get_if<WrittenUnit>(&read)) {
      node.value *= unit->factor;
      node.dimension = unit->dimension;
      return;
    }
    const auto& error = std::get<UnitError>(read);
    problems_.push_back({.kind = FormulaProblem::Kind::kUnit,
                         .at = token.at + 1 + error.at,
                         .length = error.length,
                         .message = error.message,
                         .label = "unknown unit",
                         .help = "units as in: 50 [N m], 20 [degC]",
                         .word = error.word,
                         .candidates = formula_units()});
    node.dimension.reset();
    node.is_number = false;
  }

  int name() {
    const Token token = now();
    ++next_;
    if (is("(")) return call(token);
    ExpressionNode node = at(token);
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      if (parameters_[i].name != token.text) continue;
      node.op = FormulaOp::kParameter;
      node.operand = static_cast<int>(i);
      if (parameters_[i].sound) node.dimension = parameters_[i].unit.dimension;
      return add(std::move(node));
    }
    if (token.text == "pi") {
      node.value = kPi;
      node.is_number = true;
      node.dimension = kNumberOnly;
      return add(std::move(node));
    }
    const auto variable = find_variable(token.text, arm_);
    if (!variable) return unknown(token, "variable");
    node.op = variable->op;
    node.operand = variable->sensor.empty() ? variable->operand : sensor(variable->sensor);
    node.dimension = variable->dimension;
    return add(std::move(node));
  }

  int sensor(const std::string& name) {
    auto& all = out_.sensors;
    const auto it = std::find(all.begin(), all.end(), name);
    const auto place = static_cast<int>(it - all.begin());
    if (it == all.end()) all.push_back(name);
    return place;
  }

  int unknown(const Token& token, const char* what) {
    auto candidates = formula_names(arm_);
    for (const auto& p : parameters_) candidates.push_back(p.name);
    std::string help = fmt::format("declare it: parameters = [\"{} [unit] ~ size\"]", token.text);
    if (find_function(token.text) != nullptr) help = token.text + "(...) needs its argument";
    problems_.push_back({.kind = FormulaProblem::Kind::kVariable,
                         .at = token.at,
                         .length = token.length,
                         .message = fmt::format("there is no {} '{}'", what, token.text),
                         .label = fmt::format("unknown {}", what),
                         .help = std::move(help),
                         .word = token.text,
                         .candidates = std::move(candidates)});
    return add(at(token));
  }

  int call(const Token& token) {
    if (depth_ > kDeepest) return fail("too much stands inside each other", "here");
    ++depth_;
    ++next_;  // (
    ExpressionNode node = at(token);
    if (!is(")")) {
      node.inner.push_back(sum());
      while (take(",")) node.inner.push_back(sum());
    }
    --depth_;
    if (!stop_ && !take(")")) return fail("a ')' is missing", "before this");
    const Function* function = find_function(token.text);
    if (stop_ || function == nullptr) return stop_ ? none() : unknown(token, "function");
    if (static_cast<int>(node.inner.size()) != function->arguments) {
      problems_.push_back(
          {.at = token.at,
           .length = token.length,
           .message = fmt::format("{} takes {} arguments, not {}", token.text, function->arguments,
                                  node.inner.size()),
           .label = "here",
           .help = "min(a, b), max(a, b), clamp(a, low, high); all others take one"});
      return add(at(token));
    }
    node.op = function->op;
    return add(std::move(node));
  }

  const std::vector<ParameterText>& parameters_;
  const FormulaArm& arm_;
  FormulaProblems& problems_;
  std::vector<Token> tokens_;
  std::size_t next_ = 0;
  int depth_ = 0;
  bool stop_ = false;
  Expression out_;
};

}  // namespace

Expression parse_expression(const std::string& text, const std::vector<ParameterText>& parameters,
                            const FormulaArm& arm, FormulaProblems& problems) {
  return ExpressionParser(text, parameters, arm, problems).parse();
}

}  // namespace plumb::offline
