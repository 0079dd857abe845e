// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <regex>
#include <set>

#include "figures/error_figures.hpp"
#include "figures/joint_residual.hpp"
#include "figures/registry.hpp"
#include "figures/words.hpp"
#include "figures/worst_band.hpp"
#include "tests/draw/text_boxes.hpp"
#include "tests/figures/made_run.hpp"
#include "tests/yardstick.hpp"

namespace plumb::offline::figures {
namespace {

using Held = MadeRun::Held;

std::set<std::string> poses_in(const std::string& svg) {
  static const std::regex kPose("data-pose=\"([^\"]*)\"");
  std::set<std::string> out;
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), kPose); it != std::sregex_iterator();
       ++it)
    out.insert((*it)[1]);
  return out;
}

/// Every figure of the run at the three widths of the page: no label touches another, none leaves
/// the drawing, and no number is missing.
void expect_sound(const MadeRun& made) {
  const RunResults results = made.results();
  for (const auto& name : figure_names(made.cell))
    for (const double width : {1280.0, 700.0, 400.0}) {
      const std::string svg = drawn(name, results, width).value();
      EXPECT_EQ(collisions(svg, width), "") << name << " at " << width;
      EXPECT_EQ(svg.find("nan"), std::string::npos) << name;
      EXPECT_EQ(svg.find("inf"), std::string::npos) << name;
      EXPECT_NE(svg.find("measured - predicted"), std::string::npos) << name;
      EXPECT_EQ(count(svg, "<svg "), 1 + count(svg, "</svg>") - 1) << name;
    }
}

TEST(Figures, AreSoundForArmsOfTwoSixAndNineJoints) {
  for (const int joints : {2, 6, 9}) expect_sound(MadeRun(60, joints));
}

TEST(Figures, AreSoundWithoutAHeldOutSetAndSayThatItIsNoAccuracy) {
  const MadeRun made(60, 6, Held::kNone);
  expect_sound(made);
  for (const auto& name : figure_names(made.cell))
    EXPECT_NE(drawn(name, made.results(), 1280.0)->find("in-sample"), std::string::npos) << name;
}

TEST(Figures, AreSoundForNoPoseOnePoseAndErrorsThatAreAllZero) {
  expect_sound(MadeRun(0, 6));
  expect_sound(MadeRun(1, 6));
  MadeRun exact(30, 6);
  exact.before_M.setZero();
  exact.after_M.setZero();
  exact.run.fit.floor = {};
  expect_sound(exact);
}

TEST(Figures, HostileNamesOfPosesStayWords) {
  MadeRun made(40, 6);
  for (auto& name : made.measured.pose) name = "\"><script>alert('" + name + "')</script>";
  for (const auto& name : figure_names(made.cell)) {
    const std::string svg = drawn(name, made.results(), 700.0).value();
    EXPECT_EQ(svg.find("<script"), std::string::npos) << name;
    EXPECT_EQ(collisions(svg, 700.0), "") << name;
  }
}

TEST(ErrorByPose, DrawsEveryHeldOutPoseAndNoOther) {
  const MadeRun made(60, 6);
  std::set<std::string> held;
  for (const int row : made.results().held) held.insert(made.results().pose(row));
  ASSERT_EQ(held.size(), 12U);
  EXPECT_EQ(poses_in(error_by_pose(made.results(), 900.0)), held);
  EXPECT_EQ(poses_in(error_map(made.results(), 900.0)), held);
}

TEST(ErrorByPose, NamesTheWorstPoseInTheDrawingAndTheSentence) {
  MadeRun made(60, 6);
  made.after_M.row(25) = Eigen::RowVector3d(0.0, 0.3e-3, 0.4e-3);
  const std::string svg = error_by_pose(made.results(), 900.0);
  EXPECT_NE(svg.find(">P26</text>"), std::string::npos);
  EXPECT_NE(where_sentence(made.results()).find("P26"), std::string::npos);
  EXPECT_NE(where_sentence(made.results()).find("0.50 mm"), std::string::npos);
}

TEST(WorstBand, IsTheOneThatWasPlanted) {
  MadeRun made(400, 6);
  const auto& q = made.measured.q;
  const double low = q.col(1).minCoeff(), step = (q.col(1).maxCoeff() - low) / 8.0;
  for (int i = 0; i < 400; ++i)
    if (q(i, 1) > low + 5.0 * step && q(i, 1) < low + 6.0 * step) made.after_M.row(i) *= 6.0;
  const auto band = worst_band(made.results());
  ASSERT_TRUE(band);
  EXPECT_EQ(band->joint, 1);
  EXPECT_NEAR(band->from, low + 5.0 * step, 0.1 * step);
  EXPECT_GT(band->mean_m, 4.0 * band->elsewhere_m);
  EXPECT_NE(where_sentence(made.results()).find("largest at " + made.cell.nominal.joints[1].name),
            std::string::npos);
}

TEST(WorstBand, NoiseHasNone) { EXPECT_FALSE(worst_band(MadeRun(400, 6).results())); }

TEST(ErrorHist, CountsEveryPoseOnceBeforeAndOnceAfter) {
  const MadeRun made(200, 6);
  const std::string svg = error_hist(made.results(), 900.0);
  const auto sum = [&](const std::string& kind) {
    const std::regex count_of(": (\\d+) " + kind + "</title>");
    int out = 0;
    for (auto it = std::sregex_iterator(svg.begin(), svg.end(), count_of);
         it != std::sregex_iterator(); ++it)
      out += std::stoi((*it)[1]);
    return out;
  };
  EXPECT_EQ(sum("held out"), 2 * 40);
  EXPECT_EQ(sum("fitted"), 2 * 160);
}

TEST(ErrorHist, SaysHowManyAreWithinTheTolerance) {
  MadeRun made(50, 6);
  for (int i = 0; i < 50; ++i)
    made.after_M.row(i) = Eigen::RowVector3d(0.0, 0.0, i < 15 ? 5e-5 : 2e-4);
  EXPECT_NE(error_hist(made.results(), 900.0).find("3 of 10 are within the tolerance of 0.10 mm"),
            std::string::npos);
}

TEST(JointResidual, FindsAnOffsetOfTheJointThatHasIt) {
  MadeRun made(300, 6);
  ArmState wrong = made.run.fit.calibration.state;
  wrong.arm.calibrated.joints[2].theta -= 200e-6;
  made.after_M = residuals(made.measured, predict_points(wrong, made.measured));
  for (const auto& joint : joint_residuals(made.results())) {
    if (joint.joint != 2) continue;
    for (const auto& mean : joint.curve) EXPECT_NEAR(mean.value, 200e-6, 2e-6);
    EXPECT_LT(joint.rms_without_curve, 0.02 * joint.rms);
  }
}

TEST(JointResidual, TheIntervalCoversZeroWhereThereIsNoiseOnly) {
  const MadeRun made(600, 6);
  int outside = 0, all = 0;
  for (const auto& joint : joint_residuals(made.results()))
    for (const auto& mean : joint.curve) {
      outside += std::abs(mean.value) > mean.half;
      ++all;
    }
  EXPECT_EQ(all, 600);
  EXPECT_LT(outside, all / 8) << "5 % expected";
  EXPECT_GT(outside, 0) << "an interval that is always right is too wide";
}

TEST(Thinning, KeepsTheWorstAndIsToldAt12000Poses) {
  MadeRun made(12000, 6);
  made.after_M.row(6000) *= 50.0;
  const RunResults results = made.results();
  for (const auto& name : {"error-by-pose", "error-map"}) {
    const std::string svg = drawn(name, results, 1280.0).value();
    EXPECT_LT(svg.size(), 1000000U) << name;
    EXPECT_TRUE(poses_in(svg).contains("P6001")) << name;
    EXPECT_NE(svg.find(" of 2400 poses are drawn"), std::string::npos) << name;
    EXPECT_EQ(collisions(svg, 1280.0), "") << name;
  }
}

TEST(Figures, TakeLessThan100MillisecondsFor1500Poses) {
  if (PLUMB_TIMED == 0) GTEST_SKIP() << "timing is judged in release";
  const MadeRun made(1500, 6);
  const RunResults results = made.results();
  for (const auto& name : figure_names(made.cell)) {
    std::vector<double> ms;
    for (int i = 0; i < 5; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      ASSERT_TRUE(drawn(name, results, 900.0));
      const std::chrono::duration<double, std::milli> took =
          std::chrono::steady_clock::now() - begin;
      ms.push_back(took.count());
    }
    std::nth_element(ms.begin(), ms.begin() + 2, ms.end());
    std::printf("%s: %.1f ms\n", name.c_str(), ms[2]);
    EXPECT_LT(ms[2], 100.0 * tests::times_slower()) << name;
  }
}

TEST(Registry, DrawsWhatItListsAndNothingElse) {
  const MadeRun made(20, 2);
  const auto names = figure_names(made.cell);
  EXPECT_EQ(names.size(), figure_list().size() + 1) << "two joints instead of JN";
  for (const auto& name : names) EXPECT_TRUE(drawn(name, made.results(), 700.0)) << name;
  for (const auto* name : {"joint-J3", "joint-JN", "", "../error-hist"})
    EXPECT_FALSE(drawn(name, made.results(), 700.0)) << name;
}

}  // namespace
}  // namespace plumb::offline::figures
