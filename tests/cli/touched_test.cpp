// SPDX-License-Identifier: Apache-2.0
// An arm without a tracker, from its touches to the model file: docs/without-a-tracker.md.
#include <gtest/gtest.h>

#include <algorithm>

#include "sandbox.hpp"
#include "tests/cases/artefact_readings.hpp"

namespace {

using plumb::offline::SocketArm;

class Touched : public testing::Test {
 protected:
  Touched() : arm_({.seed = 31, .known_distance = true}) {
    box_.write("cell.toml", arm_.cell_toml());
    box_.write("measurements.csv", arm_.measurements_csv());
  }
  SocketArm arm_;
  Sandbox box_;
};

TEST_F(Touched, PointsAreFittedListedAndCompiled) {
  const Ran fit = box_.plumb({"fit", "--json"});
  ASSERT_EQ(fit.exit, 0) << fit.err;
  const auto points = fit.json()["result"]["points"];
  EXPECT_TRUE(points["size_known"].get<bool>());
  ASSERT_EQ(points["touched"].size(), arm_.sockets().size());
  EXPECT_EQ(points["touched"][0]["name"], "0/0");
  ASSERT_EQ(points["distances"].size(), 6u);
  for (const auto& one : points["distances"]) {
    EXPECT_NEAR(one["distance_mm"].get<double>(), 80.0, 0.15);
    EXPECT_EQ(one["stated_mm"], 80.0);
  }
  const Ran text = box_.plumb({"compare"});
  EXPECT_EQ(text.exit, 0) << text.err;
  EXPECT_EQ(box_.plumb({"compile"}).exit, 0);
}

TEST_F(Touched, CheckSaysWhatPointsCannotTell) {
  const Ran check = box_.plumb({"check"});
  EXPECT_EQ(check.exit, 0) << check.err;
  EXPECT_NE((check.out + check.err).find("do not tell units and conventions"), std::string::npos);
  EXPECT_EQ((check.out + check.err).find("W-CHECK-COPY"), std::string::npos);
}

TEST_F(Touched, WhatNeedsMeasuredPositionsIsRefused) {
  const Ran plan = box_.plumb({"plan", "--n", "5"});
  EXPECT_EQ(plan.exit, 3);
  EXPECT_NE(plan.err.find("E-PLAN-POINT"), std::string::npos) << plan.err;
  ASSERT_EQ(box_.plumb({"fit"}).exit, 0);
  box_.write("tracker.csv",
             "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n1,2,3,4,5,6,500,0,300\n");
  const Ran recheck = box_.plumb({"recheck", "--data", "tracker.csv"});
  EXPECT_EQ(recheck.exit, 3);
  EXPECT_NE(recheck.err.find("E-RECHECK-POINT"), std::string::npos) << recheck.err;
}

/// The other kinds of that page: from their file to the model file.
class OtherReadings : public testing::TestWithParam<plumb::offline::ArtefactPlan::Kind> {};

TEST_P(OtherReadings, AreFittedListedComparedDiagnosedAndCompiled) {
  using Kind = plumb::offline::ArtefactPlan::Kind;
  SocketArm arm({.seed = 32});
  Sandbox box;
  box.write("cell.toml", arm.cell_toml());
  box.write("measurements.csv", artefact_readings(arm, {.kind = GetParam()}));
  const bool length =
      GetParam() == Kind::kBall || GetParam() == Kind::kDistance || GetParam() == Kind::kWire;
  const Ran fit = box.plumb({"fit", "--json"});
  ASSERT_EQ(fit.exit, 0) << fit.err;
  const auto result = fit.json()["result"];
  EXPECT_EQ(result["artefacts"]["size_known"], length);
  ASSERT_EQ(result["artefacts"]["found"].size(), 6u);
  for (const auto& one : result["artefacts"]["found"]) {
    if (!one.contains("length_mm")) continue;
    const double expected = one["kind"] == "sphere" ? 120.0 : 312.7;
    EXPECT_NEAR(one["length_mm"].get<double>(), expected, 0.5);
  }
  EXPECT_NE(fit.err.find("W-CSV-AXES"), std::string::npos) << fit.err;
  const Ran text = box.plumb({"fit"});
  EXPECT_EQ(text.out.find("of unknown size") == std::string::npos, length) << text.out;
  for (const char* verb : {"check", "compare", "diagnose", "compile", "report"}) {
    const Ran ran = box.plumb({verb});
    EXPECT_EQ(ran.exit, 0) << verb << "\n" << ran.out << ran.err;
  }
  if (!length) {
    const Ran gate = box.plumb({"compile", "--gate", "--force"});
    EXPECT_EQ(gate.exit, 1) << gate.err;
    EXPECT_NE(gate.err.find("nothing that was read tells the size of the arm"), std::string::npos)
        << gate.err;
  }
  for (const char* how : {"--n=5", "--recheck", "--separate=joint_compliance,link_flexure"}) {
    const Ran plan = box.plumb({"plan", how});
    EXPECT_EQ(plan.exit, 3) << how;
    EXPECT_NE(plan.err.find("E-PLAN-POINT"), std::string::npos) << how << plan.err;
  }
}

INSTANTIATE_TEST_SUITE_P(All, OtherReadings,
                         testing::Values(plumb::offline::ArtefactPlan::Kind::kPlane,
                                         plumb::offline::ArtefactPlan::Kind::kHeight,
                                         plumb::offline::ArtefactPlan::Kind::kSphere,
                                         plumb::offline::ArtefactPlan::Kind::kBall,
                                         plumb::offline::ArtefactPlan::Kind::kDistance,
                                         plumb::offline::ArtefactPlan::Kind::kWire));

}  // namespace
