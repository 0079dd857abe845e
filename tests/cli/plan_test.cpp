// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "sandbox.hpp"

namespace {

class PlanVerb : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "compliance", "cell"}).exit, 0);
  }
  static void TearDownTestSuite() { delete box; }
  static Ran plan(std::vector<std::string> more) {
    std::vector<std::string> words{"-C", "cell", "plan", "--pool", "300"};
    words.insert(words.end(), more.begin(), more.end());
    return box->plumb(words);
  }
  static Sandbox* box;
};
Sandbox* PlanVerb::box = nullptr;

TEST_F(PlanVerb, WritesPosesThatOtherVerbsRead) {
  ASSERT_EQ(plan({"--n", "12", "-o", "next.csv"}).exit, 0);
  const Csv csv = box->csv("next.csv");
  EXPECT_EQ(csv.rows(), 12U);
  ASSERT_EQ(box->plumb({"-C", "cell", "compile"}).exit, 0);
  const Ran predicted =
      box->plumb({"predict", "cell/robot.plumb", "--data", "next.csv", "-o", "p.csv"});
  EXPECT_EQ(predicted.exit, 0) << predicted.err;
  const auto nominal = csv.numbers("nx_mm"), real = box->csv("p.csv").numbers("px_mm");
  for (std::size_t i = 0; i < nominal.size(); ++i) EXPECT_NEAR(nominal[i], real[i], 10.0);
}

TEST_F(PlanVerb, GivesOneObjectThatPromisesLessUncertainty) {
  const Ran ran = plan({"--n", "10", "--json", "--dry-run", "-o", "none.csv"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto result = ran.json().at("result");
  EXPECT_EQ(result.at("poses").size(), 10U);
  EXPECT_LT(result.at("after").at("worst_mm"), result.at("before").at("worst_mm"));
  EXPECT_LT(result.at("after").at("mean_mm"), result.at("before").at("mean_mm"));
  EXPECT_FALSE(std::filesystem::exists(box->path() / "none.csv"));
}

TEST_F(PlanVerb, ReplacesNothingWithoutForce) {
  ASSERT_EQ(plan({"--n", "4", "-o", "once.csv"}).exit, 0);
  const std::string before = box->read("once.csv");
  EXPECT_EQ(plan({"--n", "5", "-o", "once.csv"}).exit, 2);
  EXPECT_EQ(box->read("once.csv"), before);
  EXPECT_EQ(plan({"--n", "5", "-o", "once.csv", "--force"}).exit, 0);
  EXPECT_EQ(box->csv("once.csv").rows(), 5U);
}

TEST_F(PlanVerb, SeparatesByWhatTheTwoDifferInAndSaysWhatToExpect) {
  const Ran ran = plan({"--n", "8", "--separate", "joint_compliance:J2,gear_harmonics:J2", "-o",
                        "apart.csv", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto result = ran.json().at("result");
  EXPECT_EQ(result.at("contrast"), "two_payloads");
  const auto expected = result.at("expected");
  EXPECT_EQ(expected.at("decides"),
            std::min(expected.at("if_first_nats"), expected.at("if_second_nats")) >= 10.0);
  const Csv csv = box->csv("apart.csv");
  const auto payload = csv.numbers("payload_kg");
  const auto without = std::count(payload.begin(), payload.end(), 0.0);
  EXPECT_GT(without, 0) << "the poses measured carried it";
  EXPECT_EQ(csv.columns.at("note").front(), "without payload");
  const Ran other = plan({"--n", "8", "--separate", "joint_compliance:J2,gear_harmonics:J2",
                          "--payload", "5,20", "-o", "loads.csv"});
  ASSERT_EQ(other.exit, 0) << other.err;
  for (const double kg : box->csv("loads.csv").numbers("payload_kg"))
    EXPECT_TRUE(kg == 5.0 || kg == 20.0) << kg;
  EXPECT_NE(other.out.find("nats"), std::string::npos) << other.out;
  const Ran sides =
      plan({"--n", "8", "--separate", "reversal:J2,gear_harmonics:J2", "-o", "sides.csv"});
  ASSERT_EQ(sides.exit, 0) << sides.err;
  const auto direction = box->csv("sides.csv").numbers("dir_j2");
  EXPECT_GT(std::count(direction.begin(), direction.end(), -1.0), 0);
  EXPECT_GT(std::count(direction.begin(), direction.end(), 1.0), 0);
}

TEST_F(PlanVerb, WhatWasMeasuredAtThePlanIsImportedAsItIs) {
  ASSERT_EQ(plan({"--n", "6", "--separate", "joint_compliance:J2,reversal:J2", "--payload", "0,20",
                  "-o", "filled.csv"})
                .exit,
            0);
  std::string filled = box->read("filled.csv");
  const std::string rows = filled.substr(filled.find("pose,"));
  std::string out;
  std::istringstream lines(rows);
  int number = 0;
  for (std::string line; std::getline(lines, line); ++number)
    out += (number == 0 ? "x_mm,y_mm,z_mm," : std::to_string(1000 + number) + ",200,300,") + line +
           "\n";
  box->write("filled.csv", out);
  const Ran ran = box->plumb({"-C", "cell", "import", "filled.csv", "-o", "cell/second.csv"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Csv second = box->csv("cell/second.csv"), planned = box->csv("filled.csv");
  EXPECT_EQ(second.numbers("payload_kg"), planned.numbers("payload_kg"));
  for (const char* column : {"dir_j1", "dir_j6", "travel_j2_deg"})
    EXPECT_EQ(second.numbers(column), planned.numbers(column)) << column;
}

TEST_F(PlanVerb, WorksBeforeAnythingIsMeasured) {
  std::filesystem::create_directories(box->path() / "bare");
  box->write("bare/cell.toml", box->read("cell/cell.toml"));
  const Ran ran =
      box->plumb({"-C", "bare", "plan", "--n", "12", "--pool", "200", "-o", "bare.csv", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.json().at("warnings").at(0).at("code"), "N-PLAN-NOMINAL");
  EXPECT_TRUE(ran.json().at("result").at("before").is_null());
}

TEST_F(PlanVerb, RefusesWhatMakesNoSenseWithAMessageThatHelps) {
  const auto refused = [&](std::vector<std::string> words, int exit, const std::string& says) {
    words.insert(words.end(), {"-o", "never.csv"});
    const Ran ran = plan(words);
    EXPECT_EQ(ran.exit, exit) << ran.err;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(box->path() / "never.csv"));
  };
  refused({"--separate", "reversl:J2,gear_harmonics:J2"}, 2, "did you mean 'reversal'");
  refused({"--separate", "reversal:J9,gear_harmonics:J2"}, 2, "no joint 'J9'");
  refused({"--separate", "reversal:J2"}, 2, "two effects, not 1");
  refused({"--separate", "reversal:J2,reversal:J2"}, 2, "two different effects");
  refused({"--separate", "gear_ripple:J2,reversal:J2"}, 2, "cycles");
  refused({"--separate", "gear_ripple:J2@cycles_per_turn=0,reversal:J2"}, 2, "greater than 0");
  refused({"--separate", "gear_ripple:J2@cycles=20,reversal:J2"}, 2, "KEY=NUMBER of gear_ripple");
  refused({"--separate", "encoder_eccentricity:J2,gear_ripple:J2@cycles_per_turn=1"}, 4,
          "E-PLAN-SAME");
  refused({"--separate", "reversal:J2,gear_harmonics:J2", "--payload", "10"}, 2, "two or more");
  refused({"--payload", "0,10"}, 2, "only with --separate");
  refused({"--box", "1,2,3"}, 2, "is no box");
  refused({"--box", "90000,90001,0,1,0,1"}, 4, "E-PLAN-BOX");
  refused({"--joint-limits", "150%"}, 2, "no share");
  refused({"--n", "0"}, 2, "--n");
}

}  // namespace
