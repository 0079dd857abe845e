// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cell/cell.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

const std::string kRobot =
    "schema = \"cell/1\"\n"
    "[robot]\n"
    "dh_convention = \"standard\"\n"
    "joints = [{ name = \"J1\", a = 100, q = [-90, 90] }, { name = \"J2\", q = [-90, 90] },\n"
    "          { name = \"J3\", type = \"prismatic\", q = [-90, 90] }]\n";

struct Keys {
  std::string expression = "k * tau2";
  std::string parameters = "\"k [rad/(N m)] ~ 1e-6\"";
  std::string target = "dq2";
  std::string more = "";
};

/// target on line 7, expression on line 8, parameters on line 9.
std::string cell_with(const Keys& keys) {
  return kRobot + "[[effects.formula]]\ntarget = \"" + keys.target + "\"\nexpression = \"" +
         keys.expression + "\"\nparameters = [" + keys.parameters + "]\n" + keys.more;
}

std::vector<Problem> problems_in(const std::string& text) {
  return problems_of([&] { parse_cell(text, "/c/cell.toml"); });
}

/// The whole message of the one problem: code, place, words, label.
std::string only(const Keys& keys) {
  const auto problems = problems_in(cell_with(keys));
  if (problems.size() != 1) {
    std::string all = std::to_string(problems.size()) + " problems";
    for (const auto& p : problems) all += "; " + p.code + " " + p.message;
    return all;
  }
  const Problem& p = problems[0];
  EXPECT_FALSE(p.help.empty()) << p.message;
  return p.code + " " + std::to_string(p.place->line) + ":" + std::to_string(p.place->column) +
         "+" + std::to_string(p.place->length) + ": " + p.message + " (" + p.place->label + ")";
}

TEST(FormulaMessage, SoundFormulasHaveNone) {
  const std::string two = "\"k [rad/(N m)] ~ 1e-6\", \"c [1/(N m)] ~ 1e-3 = 2e-3\"";
  for (const Keys& keys : std::initializer_list<Keys>{
           {},
           {"k * tau2 * (1 + c*abs(tau2))", two, "dq2", "name = \"motor_heat\"\n"},
           {"k*tanh(tau1 / 50 [N m])", "\"k [urad] ~ 100\"", "pre1.rx"},
           {"k*clamp(tau2, 0, 100 [Nm])", "\"k [m/(N m)] ~ 1e-8\"", "tcp.z"},
           {"k*(temp_arm - 20 [degC])*payload", "\"k [rad/(K kg)] ~ 1e-6\"", "tool.ry"},
           {"k*sqrt(x^2 + y^2)/1[m] + 0", "\"k [um] ~ 10\"", "post2.dz"},
           {"k*q3*dir2*(1-exp(-travel2/r))", "\"k [1] ~ 1e-5\", \"r [deg] ~ 0.5\"", "dq3"},
           {"a*u2 + b*sin(2*pi*row/30)", "\"a [rad] ~ 1e-4\", \"b [rad] ~ 1e-4\"", "dq1",
            "domain = \"procedure\"\n"}})
    EXPECT_EQ(problems_in(cell_with(keys)).size(), 0u) << keys.expression << ": " << only(keys);
  EXPECT_EQ(
      only({"k*t^0.5", "\"k [m/s] ~ 1e-8\"", "base.dx"}),
      "E-FORMULA-UNIT 8:15+7: the expression is in m/s^0.5, but base.dx is in m (wrong unit)");
}

TEST(FormulaMessage, OfUnitsPointsAtTheSignThatJoinsThem) {
  EXPECT_EQ(only({.expression = "k * (tau2 + q2)"}),
            "E-FORMULA-UNIT 8:25+1: a sum of N m and 1 (units differ)");
  EXPECT_EQ(only({.expression = "k * tau2 * tau1"}),
            "E-FORMULA-UNIT 8:15+15: the expression is in N m, but dq2 is in rad (wrong unit)");
  EXPECT_EQ(only({.target = "dq3"}),
            "E-FORMULA-UNIT 8:15+8: the expression is in 1, but dq3 is in m (wrong unit)");
  EXPECT_EQ(only({.expression = "k * tau2 * sin(tau1)"}),
            "E-FORMULA-UNIT 8:26+3: sin of a quantity in N m (wants a plain number)");
  EXPECT_EQ(only({.expression = "k * tau2 * 2^payload"}),
            "E-FORMULA-UNIT 8:27+1: the exponent is in kg (wants a plain number)");
  EXPECT_EQ(only({.expression = "k * tau2^q1"}),
            "E-FORMULA-UNIT 8:23+1: a quantity in N m to a power that varies (has no unit)");
  EXPECT_EQ(only({.expression = "k * max(tau2, 50)"}),
            "E-FORMULA-UNIT 8:19+3: the smaller or larger of N m and 1 (units differ)");
  EXPECT_EQ(only({.expression = "k * max(tau2, 50 [Nmm])"}),
            "E-FORMULA-UNIT 8:33+3: 'Nmm' is no unit (did you mean 'mm'?)");
  EXPECT_EQ(only({.parameters = "\"k [rad/(Nn m)] ~ 1\""}),
            "E-FORMULA-UNIT 9:24+2: 'Nn' is no unit (did you mean 'N'?)");
}

TEST(FormulaMessage, OfNamesSaysWhatMayBeMeant) {
  EXPECT_EQ(only({.expression = "k * tou2"}),
            "E-FORMULA-VARIABLE 8:19+4: there is no variable 'tou2' (did you mean 'tau2'?)");
  EXPECT_EQ(only({.expression = "k * tau2 * zebra"}),
            "E-FORMULA-VARIABLE 8:26+5: there is no variable 'zebra' (unknown variable)");
  EXPECT_EQ(only({.expression = "k * tau2 * tanhh(q1)"}),
            "E-FORMULA-VARIABLE 8:26+5: there is no function 'tanhh' (did you mean 'tanh'?)");
  EXPECT_EQ(only({.target = "dq4"}),
            "E-FORMULA-TARGET 7:11+3: a formula cannot move 'dq4' (did you mean 'dq1'?)");
  EXPECT_EQ(only({.target = "elbow"}),
            "E-FORMULA-TARGET 7:11+5: a formula cannot move 'elbow' (no target)");
  EXPECT_EQ(
      only({.more = "name = \"motor heat\"\n"}),
      "E-FORMULA-NAME 10:8+12: 'motor heat' is no name for a formula (letters, digits and _)");
}

TEST(FormulaMessage, OfConstantsThatAreNoNumber) {
  EXPECT_EQ(only({.expression = "k * tau2 / (1 - 1)"}),
            "E-FORMULA-NUMBER 8:24+1: this divides by zero, whatever the pose (the divisor is 0)");
  EXPECT_EQ(only({.expression = "k * tau2 * log(-2)"}),
            "E-FORMULA-NUMBER 8:26+3: this is no number, whatever the pose "
            "(infinite or undefined)");
  EXPECT_EQ(only({.expression = "k * tau2 * 10^400"}),
            "E-FORMULA-NUMBER 8:28+1: this is no number, whatever the pose "
            "(infinite or undefined)");
}

TEST(FormulaMessage, OfParameters) {
  EXPECT_EQ(only({.parameters = "\"k [rad/(N m)] ~ 1e-6\", \"c [1] ~ 1\""}),
            "E-FORMULA-PARAMETER 9:40+1: the expression does not use 'c' (declared here)");
  EXPECT_EQ(only({.parameters = "\"k ~ 1e-6\""}),
            "E-FORMULA-PARAMETER 9:18+1: parameter 'k' has no unit ([1] if it has none)");
  EXPECT_EQ(only({.parameters = "\"k [rad/(N m)]\""}),
            "E-FORMULA-PARAMETER 9:29+1: parameter 'k' has no typical size (~ 1e-6)");
  EXPECT_EQ(only({.parameters = "\"k [rad/(N m)] ~ -1\""}),
            "E-FORMULA-PARAMETER 9:32+2: a typical size is a number above 0 (here)");
  EXPECT_EQ(only({.parameters = "\"k [rad/(N m)] ~ 1 = x\""}),
            "E-FORMULA-PARAMETER 9:36+1: a start is a number (here)");
  EXPECT_EQ(only({.expression = "q1", .parameters = "\"q1 [1] ~ 1\""}),
            "E-FORMULA-PARAMETER 9:16+2: 'q1' is a name of its own in formulas (choose another)");
  EXPECT_EQ(only({.parameters = "\"k [rad/(N m)] ~ 1e-6\", \"k [rad/(N m)] ~ 1e-6\""}),
            "E-FORMULA-PARAMETER 9:40+1: parameter 'k' is declared twice (again)");
}

TEST(FormulaMessage, OfSyntaxPointsAtTheFirstWordThatDoesNotFit) {
  EXPECT_EQ(only({.expression = "k * (tau2"}),
            "E-FORMULA-SYNTAX 8:24+1: a ')' is missing (before this)");
  EXPECT_EQ(only({.expression = "k * tau2 +"}),
            "E-FORMULA-SYNTAX 8:25+1: the formula ends too early (more is needed)");
  EXPECT_EQ(only({.expression = "k tau2"}),
            "E-FORMULA-SYNTAX 8:17+4: 'tau2' is not expected here (here)");
  EXPECT_EQ(only({.expression = "k * tau2 ** 2"}),
            "E-FORMULA-SYNTAX 8:25+1: '**' is not a sign here (a power is written ^)");
  EXPECT_EQ(only({.expression = "k * tau2 * min(1)"}),
            "E-FORMULA-SYNTAX 8:26+3: min takes 2 arguments, not 1 (here)");
  EXPECT_EQ(only({.expression = "k * tau2 ; 1"}),
            "E-FORMULA-SYNTAX 8:24+1: this does not belong to a formula (unknown sign)");
  EXPECT_EQ(only({.expression = ""}), "E-FORMULA-SYNTAX 8:15+1: there is no expression (k * tau2)");
}

TEST(FormulaMessage, OfLengthComesBeforeTheCycleSeesIt) {
  std::string many = "k * tau2 * (1";
  for (int i = 1; i < 60; ++i) many += " + q1";
  EXPECT_TRUE(problems_in(cell_with({.expression = many + ")"})).empty());
  for (int i = 0; i < 10; ++i) many += " + q2";
  const std::string long_one = only({.expression = many + ")"});
  EXPECT_NE(long_one.find("E-FORMULA-LONG 8:15"), std::string::npos) << long_one;
  EXPECT_NE(long_one.find("the formula has 143 operations, at most 128 fit"), std::string::npos)
      << long_one;
  std::string deep = "k * tau2 * q1";
  for (int i = 0; i < 25; ++i) deep = "q2 + (" + deep;
  deep = "k * tau2 * (" + deep.substr(0, deep.size() - 13) + "q1" + std::string(26, ')');
  const std::string deep_one = only({.expression = deep});
  EXPECT_NE(deep_one.find("numbers waiting at once, at most 24"), std::string::npos) << deep_one;
}

TEST(FormulaMessage, OfADomainThatCannotRead) {
  EXPECT_EQ(only({.expression = "k * u2", .parameters = "\"k [rad] ~ 1e-4\""}),
            "E-FORMULA-DOMAIN 8:19+2: this is not known in the robot's cycle "
            "(of the measurement only)");
  EXPECT_EQ(only({.more = "domain = \"robt\"\n"}).substr(0, 18), "E-CELL-RANGE 10:10");
}

TEST(FormulaMessage, OfAllThatIsWrongComesInOnePass) {
  const auto problems =
      problems_in(cell_with({"k * (tau2 + q2) / 0 + tou1", "\"k [1] ~ 1\", \"c [1] ~ 0\"", "dq9"}));
  EXPECT_EQ(summary(problems), (Summary{"E-FORMULA-TARGET 7:11", "E-FORMULA-UNIT 8:25",
                                        "E-FORMULA-NUMBER 8:31", "E-FORMULA-VARIABLE 8:37",
                                        "E-FORMULA-PARAMETER 9:29", "E-FORMULA-PARAMETER 9:37"}));
}

TEST(FormulaMessage, OfKeysMissingOrTwice) {
  EXPECT_EQ(summary(problems_in(kRobot + "[[effects.formula]]\n")),
            (Summary{"E-CELL-MISSING 6:1", "E-CELL-MISSING 6:1"}));
  EXPECT_EQ(summary(problems_in(kRobot + "[effects]\nformula = true\n")),
            Summary{"E-CELL-TYPE 7:11"});
  const std::string again =
      "[[effects.formula]]\ntarget = \"dq2\"\nexpression = \"k * tau1\"\n"
      "parameters = [\"k [rad/(N m)] ~ 1e-6\"]\n";
  EXPECT_EQ(summary(problems_in(cell_with({}) + again)), Summary{"E-FORMULA-NAME 11:10"});
  EXPECT_TRUE(problems_in(cell_with({}) + again + "name = \"other\"\n").empty());
}

TEST(FormulaMessage, IsRenderedWithACaretInsideTheExpression) {
  const auto problems = problems_in(cell_with({.expression = "k * (tau2 + q2)"}));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(render(problems[0])
                .find(" 8 | expression = \"k * (tau2 + q2)\"\n"
                      "   |                         ^ units differ\n"
                      "   = help: "),
            std::string::npos)
      << render(problems[0]);
}

TEST(Formula, IsWrittenAndReadBackTheSame) {
  const Cell cell =
      parse_cell(cell_with({"k * tau2 * (1 + c*abs(tau2))",
                            "\"k [rad/(N m)] ~ 1e-6\", \"c [1/(N m)] ~ 1e-3 = 2e-3\"", "dq2",
                            "name = \"motor_heat\"\ndomain = \"environment\"\n"}) +
                     "[[effects.formula]]\ntarget = \"dq1\"\nexpression = 'k * tau1'\n"
                     "parameters = [\"k [rad/(N m)] ~ 1e-6\"]\n",
                 "/c/cell.toml");
  const Cell again = parse_cell(write_cell(cell), "/c/cell.toml");
  ASSERT_EQ(again.effects.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(again.effects[i].options, cell.effects[i].options);
}

}  // namespace
}  // namespace plumb::offline
