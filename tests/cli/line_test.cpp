// SPDX-License-Identifier: Apache-2.0
// Every verb's ordinary way, on every sample cell.
#include <gtest/gtest.h>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

class WholeLine : public testing::TestWithParam<std::string> {};

TEST_P(WholeLine, FromMeasurementsToACorrectedPose) {
  const Sandbox box;
  const auto ok = [&](const std::vector<std::string>& words) {
    const Ran ran = box.plumb(words);
    EXPECT_EQ(ran.exit, 0) << words[0] << " " << words[1] << "\n" << ran.err;
    EXPECT_FALSE(ran.out.empty());
    return ran;
  };
  ok({"demo", GetParam(), "cell"});
  ok({"-C", "cell", "fit"});
  ok({"-C", "cell", "compare"});
  ok({"-C", "cell", "runs"});
  ok({"-C", "cell", "compile"});
  ok({"inspect", "cell/robot.plumb"});
  ok({"predict", "cell/robot.plumb", "--data", "cell/measurements.csv", "-o", "p.csv"});
  ok({"correct", "cell/robot.plumb", "--data", "cell/targets.csv", "-o", "c.csv"});
  EXPECT_EQ(box.csv("p.csv").rows(), box.csv("cell/measurements.csv").rows());
  EXPECT_EQ(box.csv("c.csv").rows(), 20U);
}

INSTANTIATE_TEST_SUITE_P(Demos, WholeLine,
                         testing::Values("compliance", "gear", "ripple", "bumped", "reversal",
                                         "thermal", "unknown", "mixed", "beam", "scara", "clean"),
                         [](const auto& demo) { return demo.param; });

TEST(Demo, ListsItsNames) {
  const Sandbox box;
  const Json demos = box.plumb({"demo", "--list", "--json"}).json().at("result").at("demos");
  EXPECT_GE(demos.size(), 11U);
  EXPECT_TRUE(box.listing().empty());
}

TEST(Demo, TheDefaultGoesToAFolderOfItsName) {
  const Sandbox box;
  const Ran ran = box.plumb({"demo"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(std::filesystem::exists(box.path() / "demo-compliance" / "cell.toml"));
  EXPECT_NE(ran.out.find("plumb -C demo-compliance fit"), std::string::npos);
}

TEST(New, WritesACellThatSimulateAndFitUnderstand) {
  const Sandbox box;
  box.write("dh.csv",
            "joint,alpha_deg,a_mm,d_mm,theta_deg,q_min_deg,q_max_deg,type\n"
            "J1,90,0,127.3,0,-180,180,revolute\n"
            "J2,0,-612,0,0,-180,0,revolute\n"
            "J3,0,-572.3,0,0,-150,150,revolute\n"
            "J4,90,0,163.9,0,-180,180,revolute\n"
            "J5,-90,0,115.7,0,-180,180,revolute\n"
            "J6,0,0,92.2,0,-180,180,revolute\n");
  const Ran made = box.plumb({"new", "cell", "--dh", "dh.csv", "--convention", "standard"});
  ASSERT_EQ(made.exit, 0) << made.err;
  const std::string cell = box.read("cell/cell.toml");
  EXPECT_NE(cell.find("dh_convention = \"standard\""), std::string::npos);
  EXPECT_NE(cell.find("-572.3"), std::string::npos);
  EXPECT_NE(cell.find("parallel_next = true"), std::string::npos);
  ASSERT_EQ(box.plumb({"-C", "cell", "simulate", "--noise-um", "0.000001", "--seed", "5"}).exit, 0);
  const Ran fitted = box.plumb({"-C", "cell", "fit", "--json"});
  ASSERT_EQ(fitted.exit, 0) << fitted.err;
  EXPECT_LT(fitted.json().at("result").at("held_out").at("max_mm"), 1e-6);
}

TEST(New, ReportsEveryMistakeOfTheTableAtOnce) {
  const Sandbox box;
  box.write("dh.csv",
            "joint,alpha_deg,a_mm,d_mm,q_min_deg,q_max_deg,type\n"
            "J1,0,0,0,10,-10,revolute\nJ2,0,0,0,-1,1,turning\n");
  const Ran ran = box.plumb({"new", "cell", "--dh", "dh.csv", "--convention", "modified"});
  EXPECT_EQ(ran.exit, 3);
  for (const auto* code : {"E-DH-COLUMN", "E-DH-LIMITS", "E-DH-TYPE"})
    EXPECT_NE(ran.err.find(code), std::string::npos) << code << ran.err;
  EXPECT_FALSE(std::filesystem::exists(box.path() / "cell"));
}

TEST(New, ReadsEveryColumnOfTheTableOrRefusesIt) {
  const Sandbox box;
  const auto made = [&](const std::string& more, const std::string& values) {
    box.write("dh.csv", "joint,alpha_deg,a_mm,d_mm,theta_deg" + more + "\nJ1,0,0,118,0" + values +
                            "\nJ2,90,0,0,0" + values + "\n");
    return box.plumb({"new", "cell", "--dh", "dh.csv", "--convention", "modified", "--force"});
  };
  for (const char* column :
       {"b_mm", "q0_deg", "theta_offset_deg", "note", "offsets_deg", "mass_kg"}) {
    const Ran ran = made(std::string(",") + column, ",1");
    EXPECT_EQ(ran.exit, 3) << column << ran.err;
    EXPECT_NE(ran.err.find("E-DH-COLUMN"), std::string::npos) << column << ran.err;
    EXPECT_NE(ran.err.find(std::string("'") + column + "'"), std::string::npos) << ran.err;
  }
  for (const auto& [column, written] :
       {std::pair{"offset_deg", "offset = -90"}, std::pair{"offset_rad", "offset = -90"},
        std::pair{"beta_deg", "beta = -90"}}) {
    const bool radians = std::string(column).ends_with("_rad");
    EXPECT_EQ(made(std::string(",") + column, radians ? ",-1.5707963267948966" : ",-90").exit, 0);
    EXPECT_NE(box.read("cell/cell.toml").find(written), std::string::npos)
        << column << box.read("cell/cell.toml");
  }
  const Ran slide = made(",offset_mm", ",35");
  EXPECT_EQ(slide.exit, 3);
  EXPECT_NE(slide.err.find("E-DH-OFFSET"), std::string::npos) << slide.err;
}

TEST(New, DegreesThatAreMultiplesOfPiOverFourAreQuestioned) {
  const Sandbox box;
  const auto warned = [&](const std::string& rows) {
    box.write("dh.csv", "joint,alpha_deg,a_mm,d_mm,theta_deg\n" + rows);
    const Ran ran =
        box.plumb({"new", "c", "--dh", "dh.csv", "--convention", "modified", "--force"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.err.find("W-DH-RADIANS") != std::string::npos;
  };
  EXPECT_TRUE(warned("J1,0,0,118,0\nJ2,1.570796,0,0,3.141593\n"));
  EXPECT_TRUE(warned("J1,-1.5708,0,118,0\nJ2,0,0,0,0.7854\n"));
  EXPECT_FALSE(warned("J1,0,0,118,0\nJ2,90,0,0,180\n"));
  EXPECT_FALSE(warned("J1,0,0,118,0\nJ2,90,0,0,1.5708\n")) << "one angle is none of radians";
  EXPECT_FALSE(warned("J1,0,0,118,0\nJ2,0,0,0,0\n"));
  EXPECT_FALSE(warned("J1,0,0,118,0.5\nJ2,0,0,0,1.2\n"));
}

TEST(KeygenVerb, AKeyHasAName) {
  const Sandbox box;
  for (const char* name : {"", "folder/"}) {
    EXPECT_EQ(box.plumb({"keygen", name}).exit, 2) << name;
    EXPECT_TRUE(box.listing().empty()) << name;
  }
}

TEST(SimulateVerb, TheSameSeedGivesTheSameBytes) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  for (const auto* name : {"a", "b"})
    ASSERT_EQ(box.plumb({"-C", "cell", "simulate", "--seed", "9", "--poses", "30", "--hidden",
                         "joint_compliance:J2=150urad", "-o", std::string(name) + ".csv", "--truth",
                         std::string(name) + ".json"})
                  .exit,
              0);
  EXPECT_EQ(box.read("a.csv"), box.read("b.csv"));
  EXPECT_EQ(box.read("a.json"), box.read("b.json"));
  EXPECT_EQ(box.csv("a.csv").rows(), 30U);
}

}  // namespace
