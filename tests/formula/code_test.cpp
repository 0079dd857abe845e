// SPDX-License-Identifier: Apache-2.0
// Stack code against <cmath>, and its exact derivatives against finite differences.
#include <gtest/gtest.h>

#include <cstdio>

#include "arm/dual.hpp"
#include "formula/compile_formula.hpp"
#include "formula/degree.hpp"
#include "plumb/format/formula.hpp"
#include "plumb/runtime/detail/formula_code.hpp"
#include "tests/formula/random_formula.hpp"

namespace plumb::offline {
namespace {

using format::FormulaOp;
using tests::between;
using tests::FormulaInput;
using tests::Random;

const FormulaArm kArm{std::vector<bool>(6, false)};

/// All four parameters are used, so that none is reported.
format::Formula compiled(const std::string& expression, FormulaProblems& problems) {
  const FormulaText text{.name = "",
                         .target = "dq1",
                         .expression = "(" + expression + ") + 0*(a + b + c + d)",
                         .parameters = {"a [1] ~ 1", "b [1] ~ 1", "c [1] ~ 1", "d [1] ~ 1"}};
  return compile_formula(text, kArm, problems).formula;
}

template <class S>
S value(const format::Formula& formula, std::span<const S> theta, const FormulaInput& in) {
  return formula::evaluate(formula, theta, [&](FormulaOp op, std::size_t which) {
    return op == FormulaOp::kPosition ? in.q[which] : in.dir[which];
  });
}

FormulaInput random_input(Random& random) {
  FormulaInput out{};
  for (double& v : out.q) v = random.uniform(-3.0, 3.0);
  for (double& v : out.dir) v = between(random, 0, 1) == 0 ? -1.0 : 1.0;
  for (double& v : out.p) v = random.uniform(-2.0, 2.0);
  return out;
}

TEST(FormulaCode, GivesWhatTheExpressionMeans) {
  const long count = tests::scaled(4000);
  constexpr std::uint64_t kSeed = 5;
  std::printf("%ld formulas, seed %llu\n", count, static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  long compared = 0, undefined = 0;
  for (long i = 0; i < count; ++i) {
    const auto truth = tests::random_formula(random, between(random, 1, 5));
    FormulaProblems problems;
    const auto formula = compiled(truth.text, problems);
    if (!problems.empty()) {
      // Only a formula too long, or infinite whatever the pose, may be refused.
      for (const auto& p : problems)
        EXPECT_TRUE(p.kind == FormulaProblem::Kind::kTooLong ||
                    p.kind == FormulaProblem::Kind::kNoNumber)
            << p.message << ": " << truth.text;
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const FormulaInput in = random_input(random);
      const double expected = truth.value(in);
      const double found = value<double>(formula, in.p, in);
      if (!std::isfinite(expected) || !std::isfinite(found)) {
        ++undefined;
        continue;
      }
      // Errors of the last place grow with what stands inside.
      EXPECT_NEAR(found, expected, 1e-9 * std::max(1.0, std::abs(expected))) << truth.text;
      ++compared;
    }
  }
  std::printf("%ld values compared, %ld not finite\n", compared, undefined);
  EXPECT_GT(compared, 2 * count);
}

TEST(FormulaCode, IsNoNumberWhereTheExpressionIsNone) {
  struct Row {
    const char* expression;
    double q1;
  };
  for (const Row& row :
       {Row{"1/q1", 0.0}, Row{"log(q1)", 0.0}, Row{"log(q1)", -1.0}, Row{"sqrt(q1)", -1.0},
        Row{"q1^0.5", -1.0}, Row{"q1^(0-1)", 0.0}, Row{"exp(q1)", 1e3}, Row{"sin(q1)", 1e6},
        Row{"min(sqrt(q1), 1)", -1.0}, Row{"min(1, sqrt(q1))", -1.0}, Row{"max(sqrt(q1), 1)", -1.0},
        Row{"max(1, sqrt(q1))", -1.0}, Row{"clamp(sqrt(q1), 0, 1)", -1.0},
        Row{"sign(sqrt(q1))", -1.0}, Row{"step(sqrt(q1))", -1.0}, Row{"abs(sqrt(q1))", -1.0},
        Row{"tanh(sqrt(q1))", -1.0}}) {
    FormulaProblems problems;
    const auto formula = compiled(row.expression, problems);
    ASSERT_TRUE(problems.empty()) << row.expression;
    FormulaInput in{};
    in.q[0] = row.q1;
    EXPECT_FALSE(formula::is_number(value<double>(formula, in.p, in))) << row.expression;
  }
}

TEST(FormulaCode, HasTheDerivativesOfItsFiniteDifferences) {
  const long count = tests::scaled(4000);
  constexpr std::uint64_t kSeed = 6;
  std::printf("%ld formulas, seed %llu\n", count, static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  long compared = 0;
  for (long i = 0; i < count; ++i) {
    const auto truth = tests::random_formula(random, between(random, 1, 5));
    FormulaProblems problems;
    const auto formula = compiled(truth.text, problems);
    if (!problems.empty()) continue;
    const FormulaInput in = random_input(random);
    std::vector<Dual> theta(in.p, in.p + 4);
    for (int k = 0; k < 4; ++k) theta[k].d(k) = 1.0;
    const Dual exact = value<Dual>(formula, theta, in);
    if (!is_number(exact)) continue;
    EXPECT_EQ(exact.v, value<double>(formula, in.p, in)) << "the same bits: " << truth.text;
    for (int k = 0; k < 4; ++k) {
      const auto slope = [&](double h) {
        FormulaInput low = in, high = in;
        low.p[k] -= h;
        high.p[k] += h;
        return (truth.value(high) - truth.value(low)) / (2.0 * h);
      };
      const double coarse = slope(2e-5), fine = slope(1e-5);
      // Only where the difference has settled: no kink or pole between.
      const double size = std::max(1.0, std::abs(fine));
      if (!(std::abs(coarse - fine) < 1e-6 * size) || size > 1e6) continue;
      EXPECT_NEAR(exact.d(k), fine, 1e-5 * size) << truth.text << " by parameter " << k;
      compared += exact.d(k) != 0.0;
    }
  }
  std::printf("%ld slopes other than 0 compared\n", compared);
  EXPECT_GT(compared, count / 2);
}

TEST(FormulaCode, KnowsWhatIsLinear) {
  struct Row {
    const char* expression;
    Degree by_a, together;
  };
  for (const Row& row : {Row{"a*q1", Degree::kLinear, Degree::kLinear},
                         Row{"a*q1 + b*sin(q2)/3 - c", Degree::kLinear, Degree::kLinear},
                         Row{"a*q1*(1 + b*q2)", Degree::kLinear, Degree::kCurved},
                         Row{"q1/a", Degree::kCurved, Degree::kCurved},
                         Row{"tanh(a*q1)", Degree::kCurved, Degree::kCurved},
                         Row{"b*exp(q1*c)", Degree::kNone, Degree::kCurved},
                         Row{"a^2", Degree::kCurved, Degree::kCurved},
                         Row{"clamp(q1, 0, a)", Degree::kCurved, Degree::kCurved},
                         Row{"sin(q1)", Degree::kNone, Degree::kNone}}) {
    std::vector<std::string> parameters;
    const std::string text = row.expression;
    for (const char name : {'a', 'b', 'c'})
      if (text.find(std::string(1, name) + "*") != std::string::npos ||
          text.find(std::string("*") + name) != std::string::npos ||
          text.find(std::string("/") + name) != std::string::npos ||
          text.find(std::string(1, name) + "^") != std::string::npos ||
          text.find(std::string(" ") + name) != std::string::npos)
        parameters.push_back(std::string(1, name) + " [1] ~ 1");
    FormulaProblems problems;
    const auto formula =
        compile_formula({.name = "", .target = "dq1", .expression = text, .parameters = parameters},
                        kArm, problems);
    ASSERT_TRUE(problems.empty()) << text << ": " << problems[0].message;
    const bool has_a = !parameters.empty() && parameters[0][0] == 'a';
    EXPECT_EQ(degree_of(formula.formula, has_a ? 0 : 9), row.by_a) << text;
    EXPECT_EQ(degree_of(formula.formula), row.together) << text;
  }
}

TEST(FormulaCode, BeginsCurvedParametersAtTheirSizeAndOthersAtZero) {
  FormulaProblems problems;
  const auto formula = compile_formula(
      {.name = "",
       .target = "dq2",
       .expression = "k*tanh(tau2/r)*(1 + c*q1)*exp(w*q2)",
       .parameters = {"k [urad] ~ 100", "r [N m] ~ 50", "c [1] ~ 0.1", "w [1] ~ 1 = 0.25"}},
      kArm, problems);
  ASSERT_TRUE(problems.empty()) << problems[0].message;
  const auto& p = formula.formula.parameters;
  EXPECT_EQ(p[0].start, 0.0);
  EXPECT_DOUBLE_EQ(p[0].typical, 1e-4);
  EXPECT_EQ(p[0].unit, "rad");
  EXPECT_EQ(p[1].start, 50.0);
  EXPECT_EQ(p[2].start, 0.0);
  EXPECT_EQ(p[3].start, 0.25);
}

}  // namespace
}  // namespace plumb::offline
