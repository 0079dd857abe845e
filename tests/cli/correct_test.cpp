// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

class CorrectVerb : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "gear", "cell"}).exit, 0);
    ASSERT_EQ(box->plumb({"-C", "cell", "compile"}).exit, 0);
  }
  static void TearDownTestSuite() { delete box; }

  static Sandbox* box;
};
Sandbox* CorrectVerb::box = nullptr;

TEST_F(CorrectVerb, CorrectsEveryTargetOfTheDemoByMillimetres) {
  const Ran ran = box->plumb(
      {"correct", "cell/robot.plumb", "--data", "cell/targets.csv", "-o", "all.csv", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Json result = ran.json().at("result");
  EXPECT_EQ(result.at("rows"), 20);
  EXPECT_EQ(result.at("status").value("ok", 0) + result.at("status").value("outside-domain", 0), 20)
      << result.dump();
  const Csv csv = box->csv("all.csv");
  double largest = 0.0;
  for (std::size_t i = 0; i < csv.rows(); ++i) {
    double squares = 0.0;
    for (const auto* axis : {"x_mm", "y_mm", "z_mm"})
      squares += std::pow(csv.numbers(std::string("c") + axis)[i] - csv.numbers(axis)[i], 2);
    largest = std::max(largest, std::sqrt(squares));
    double norm = 0.0;
    for (const auto* part : {"cqw", "cqx", "cqy", "cqz"}) norm += std::pow(csv.numbers(part)[i], 2);
    EXPECT_NEAR(norm, 1.0, 1e-12);
  }
  EXPECT_NEAR(largest, result.at("largest_correction_mm").get<double>(), 1e-9);
  EXPECT_GT(largest, 0.05);
  EXPECT_LT(largest, 20.0);
}

TEST_F(CorrectVerb, WithoutAJointStateThereIsNothingToStartFrom) {
  const Csv csv = box->csv("cell/targets.csv");
  box->write("bare.csv", csv.without({"q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"}));
  const Ran none =
      box->plumb({"correct", "cell/robot.plumb", "--data", "bare.csv", "-o", "n.csv", "--json"});
  EXPECT_EQ(none.exit, 3);
  EXPECT_EQ(none.json().at("error").at("code"), "E-TARGET-SEED");
  std::string start;
  for (int j = 1; j <= 6; ++j)
    start += (j == 1 ? "" : ",") + csv.columns.at("q" + std::to_string(j) + "_deg")[0];
  const Ran some = box->plumb(
      {"correct", "cell/robot.plumb", "--data", "bare.csv", "--start=" + start, "-o", "s.csv"});
  ASSERT_EQ(some.exit, 0) << some.err;
  EXPECT_EQ(box->csv("s.csv").columns.at("status")[0], "ok");
}

TEST_F(CorrectVerb, WithoutAQuaternionTheSeedsOrientationIsMeantAndSaid) {
  box->write("plain.csv", box->csv("cell/targets.csv").without({"qw", "qx", "qy", "qz"}));
  const Ran ran = box->plumb({"correct", "cell/robot.plumb", "--data", "plain.csv", "-o", "o.csv"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.err.find("note[N-TARGET-ORIENTATION]"), std::string::npos) << ran.err;
  ASSERT_EQ(
      box->plumb({"correct", "cell/robot.plumb", "--data", "cell/targets.csv", "-o", "w.csv"}).exit,
      0);
  const Csv with = box->csv("w.csv"), out = box->csv("o.csv");
  for (const auto* column : {"cx_mm", "cy_mm", "cz_mm", "cqw", "cqx", "cqy", "cqz"})
    for (std::size_t i = 0; i < out.rows(); ++i)
      EXPECT_NEAR(out.numbers(column)[i], with.numbers(column)[i], 2e-6) << column;
}

TEST_F(CorrectVerb, ATargetOutOfReachIsRefusedAndStaysItself) {
  box->write("far.csv",
             "x_mm,y_mm,z_mm,qw,qx,qy,qz,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n"
             "9000,0,500,1,0,0,0,10,-60,70,20,40,30\n");
  const Ran ran =
      box->plumb({"correct", "cell/robot.plumb", "--data", "far.csv", "-o", "far_out.csv"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.err.find("warning[W-CORRECT-REFUSED]"), std::string::npos);
  const Csv out = box->csv("far_out.csv");
  EXPECT_NE(out.columns.at("status")[0], "ok");
  EXPECT_EQ(out.numbers("cx_mm")[0], 9000.0);
}

TEST_F(CorrectVerb, BadTargetsAreExitThreeWithTheirPlace) {
  box->write("bad.csv", "x_mm,y_mm,z\n1,2,3\n");
  const Ran ran = box->plumb({"correct", "cell/robot.plumb", "--data", "bad.csv", "-o", "b.csv"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("bad.csv:1:11"), std::string::npos) << ran.err;
  EXPECT_FALSE(std::filesystem::exists(box->path() / "b.csv"));
}

}  // namespace
