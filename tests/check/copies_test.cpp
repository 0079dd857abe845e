// SPDX-License-Identifier: Apache-2.0
#include "check/copies.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "check/check.hpp"
#include "check/equal_repeats.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/check/scrambled.hpp"

/// Equal readings that are copies, and equal readings that rounding makes.
namespace plumb::offline {
namespace {

struct Export {
  double noise_m = 3e-6;
  const char* digits = "{:.2f}";  // of the points [mm]
  int repeats = 5;                // of each of 20 poses; 180 poses more are measured once
  double joint_noise_deg = 0.0;   // of the joint positions that were read with each point
  std::uint64_t seed = 1;
};

struct Copied {
  int rows = 0;        // the last repeats of so many poses
  bool joints = true;  // with their joint positions
};

scrambled::Case exported(const Export& how, const Copied& copied = {}) {
  const Cell cell = random_cell(how.seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = 200;
  plan.repeats = how.repeats;
  plan.noise_m = how.noise_m;
  plan.seed = how.seed;
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.5e-3;
  const MeasurementFiles m = simulate(cell, plan).measured;
  tests::Random random(how.seed);
  std::string csv = "pose,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n";
  std::string joints, points;
  int left = copied.rows;
  for (int i = 0; i < m.size(); ++i) {
    const bool last =
        i > 0 && m.pose[i] == m.pose[i - 1] && (i + 1 == m.size() || m.pose[i] != m.pose[i + 1]);
    const bool is_copy = last && left-- > 0;
    if (!is_copy || !copied.joints) {
      joints.clear();
      for (int j = 0; j < 6; ++j)
        joints += fmt::format(
            ",{:.5f}", m.q(i, j) * 180.0 / M_PI + random.uniform(-1.0, 1.0) * how.joint_noise_deg);
    }
    if (!is_copy) {
      points.clear();
      for (int k = 0; k < 3; ++k)
        points += "," + fmt::format(fmt::runtime(how.digits), m.p_M(i, k) * 1e3);
    }
    csv += m.pose[i] + joints + points + "\n";
  }
  const scrambled::Folder folder;
  return scrambled::opened({write_cell(cell), csv, {}}, folder.path());
}

std::vector<Problem> findings(const scrambled::Case& c) {
  return copy_findings(c.measured, noise_floor(c.cell, c.measured));
}

TEST(Copies, RepeatsThatRoundingMakesEqualAreNone) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const double noise_m : {1e-6, 2e-6, 3e-6, 5e-6, 10e-6}) {
      const auto found = findings(exported({.noise_m = noise_m, .seed = seed}));
      EXPECT_TRUE(found.empty()) << noise_m << " seed " << seed << " " << found.front().message;
    }
}

TEST(Copies, CheckSaysNothingOfThemEither) {
  const auto c = exported({});
  for (const Problem& problem : check_cell(c.cell, c.measured).findings)
    EXPECT_NE(problem.code, "W-CHECK-COPY") << problem.message;
}

TEST(Copies, OfPointsWithAllTheirDigitsAreNamedHoweverFew) {
  for (const int repeats : {2, 5})
    for (const bool joints : {true, false}) {
      const auto found = findings(
          exported({.digits = "{:.5f}", .repeats = repeats}, {.rows = 1, .joints = joints}));
      ASSERT_EQ(found.size(), 1U) << repeats;
      EXPECT_NE(found[0].message.find("1 of "), std::string::npos) << found[0].message;
      EXPECT_NE(found[0].help.find("delete the copies"), std::string::npos);
    }
}

TEST(Copies, BeyondWhatRoundingExplainsAreNamed) {
  // Noise of one and a half steps makes hardly any reading equal.
  const auto found = findings(exported({.noise_m = 15e-6}, {.rows = 18}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].help.find("delete the copies"), std::string::npos);
}

TEST(Copies, AreNamedByTheirJointPositionsWherePointsCannotTell) {
  const Export how{.joint_noise_deg = 0.002};
  EXPECT_TRUE(findings(exported(how)).empty());
  const auto found = findings(exported(how, {.rows = 6}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].message.find("6 of "), std::string::npos) << found[0].message;
}

TEST(Copies, OfWhichNothingTellsMayBeEither) {
  auto c = exported({.noise_m = 0.1e-6, .repeats = 2});
  c.cell.measurement.sigma_m.reset();
  const auto found = findings(c);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].message.find("rounded to 0.01 mm, so these may be copies or true repeats"),
            std::string::npos)
      << found[0].message;
  EXPECT_NE(found[0].help.find("with all their digits"), std::string::npos);
}

TEST(Copies, TheStatedNoiseTellsWhereFewRepeatsDo) {
  auto c = exported({.noise_m = 0.1e-6, .repeats = 2});
  c.cell.measurement.sigma_m = 1e-6;
  EXPECT_TRUE(findings(c).empty());
  c.cell.measurement.sigma_m = 100e-6;
  const auto found = findings(c);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].help.find("delete the copies"), std::string::npos);
}

TEST(EqualRepeats, AreAsManyAsRoundedReadingsShow) {
  // Against counting: 20 poses of 5 repeats, ten seeds.
  double expected = 0.0, counted = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto c = exported({.noise_m = 8e-6, .repeats = 5, .seed = seed});
    expected += equal_by_rounding(c.measured, noise_floor(c.cell, c.measured)).points;
    for (int i = 0; i < c.measured.size(); ++i)
      for (int k = 0; k < i; ++k)
        if (c.measured.replicate_group[i] == c.measured.replicate_group[k] &&
            c.measured.p_M.row(i) == c.measured.p_M.row(k)) {
          counted += 1.0;
          break;
        }
  }
  EXPECT_GT(counted, 20.0);
  EXPECT_NEAR(expected / counted, 1.0, 0.35) << expected << " " << counted;
}

}  // namespace
}  // namespace plumb::offline
