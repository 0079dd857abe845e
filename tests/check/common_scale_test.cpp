// SPDX-License-Identifier: Apache-2.0
// One factor on all measured points, as the scale of a tracker makes it.
#include "check/common_scale.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/check/simulated_arm.hpp"

namespace plumb::offline {
namespace {

/// An arm that is built as it should be, seen through an instrument that multiplies by `factor`.
SimulatedArm seen_larger(std::uint64_t seed, double factor) {
  SimulatedArm out = simulated_arm(seed, 100, 20e-6);
  out.measured.p_M *= factor;
  return out;
}

std::vector<Problem> scale_of_fit(const SimulatedArm& at) {
  return scale_findings(at.measured, at.rows, calibrate(at.cell, at.measured, at.rows));
}

/// The number that stands behind these words; NaN if they do not.
double number_behind(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? NAN : std::atof(text.c_str() + at + words.size());
}

TEST(CommonScale, IsTheFactorThatThePointsWereMultipliedBy) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const double ppm : {3000.0, 800.0, -800.0, -3000.0}) {
      const auto found = scale_of_fit(seen_larger(seed, 1.0 + 1e-6 * ppm));
      ASSERT_EQ(found.size(), 1U) << seed << " " << ppm;
      EXPECT_EQ(found.front().code, "W-CHECK-SCALE");
      const std::string& said = found.front().message;
      EXPECT_NEAR(number_behind(said, "by one factor, "), 1.0 + 1e-6 * ppm, 0.05e-6 * std::abs(ppm))
          << said;
      EXPECT_TRUE(holds(said, ppm > 0.0 ? "all longer" : "all shorter")) << said;
    }
}

TEST(CommonScale, IsNotSaidOfArmsThatAreOffEachLengthByItself) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    EXPECT_TRUE(scale_of_fit(seen_larger(seed, 1.0)).empty()) << seed;
    EXPECT_TRUE(scale_of_fit(simulated_arm(seed, 100, 1e-3)).empty()) << seed;
  }
}

/// The factor is far above its scatter, but the longest lengths do not ask for it.
TEST(CommonScale, IsNotSaidWhereTheLongestLengthAloneIsWrong) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SimulatedArm at = simulated_arm(seed, 100, 20e-6);
    format::JointRow* longest = nullptr;
    for (auto& joint : at.cell.nominal.joints)
      if (longest == nullptr || std::abs(joint.a) > std::abs(longest->a)) longest = &joint;
    longest->a *= 0.995;
    EXPECT_TRUE(scale_of_fit(at).empty()) << seed;
  }
}

TEST(CommonScale, DoesNotDependOnWhereTheInstrumentStands) {
  const double factor = 1.002;
  SimulationPlan plan = plan_of_arm(2, 100, 20e-6);
  plan.truth.seed = 2;
  plan.noise_m = 1e-6;
  std::vector<double> found;
  for (const double x : {0.0, 3.0, -8.0}) {
    plan.truth.X_MB = format::Pose{{x, 0.5 * x, 0.1}, {0.8, 0.0, 0.36, 0.48}};
    SimulatedArm at = measured_by(six_joint_cell(2), plan);
    at.measured.p_M *= factor;
    const auto said = scale_of_fit(at);
    ASSERT_EQ(said.size(), 1U) << x;
    found.push_back(number_behind(said.front().message, "by one factor, "));
  }
  EXPECT_NEAR(found[1], found[0], 3e-5);
  EXPECT_NEAR(found[2], found[0], 3e-5);
}

TEST(CommonScale, IsNotLookedForWithoutAnAxisOrWithFewPoses) {
  SimulatedArm at = seen_larger(1, 1.003);
  const Calibration fitted = calibrate(at.cell, at.measured, at.rows);
  EXPECT_EQ(scale_findings(at.measured, at.rows, fitted).size(), 1U);
  EXPECT_TRUE(scale_findings(at.measured, {0, 1, 2, 3, 4}, fitted).empty());
  at.measured.has_axis[2] = false;
  EXPECT_TRUE(scale_findings(at.measured, at.rows, fitted).empty());
}

Detection labelled_in(const std::string& unit) {
  Detection out;
  out.present.convention.point_unit = unit;
  return out;
}

std::optional<GrossScale> gross_of(const SimulatedArm& at, const std::string& unit = "mm") {
  return gross_scale(at.cell, at.measured, at.rows, labelled_in(unit));
}

TEST(GrossScale, OfPointsInAnotherUnitIsThatUnit) {
  struct Unit {
    const char* is;
    double metres;
  };
  for (const Unit& unit : {Unit{"in", 25.4e-3}, Unit{"cm", 1e-2}, Unit{"m", 1.0},
                           Unit{"ft", 0.3048}, Unit{"um", 1e-6}}) {
    SimulatedArm at = simulated_arm(4);
    at.measured.p_M *= 1e-3 / unit.metres;  // the numbers of that unit, read as mm
    const auto found = gross_of(at);
    ASSERT_TRUE(found) << unit.is;
    EXPECT_TRUE(found->is_unit) << unit.is;
    EXPECT_TRUE(holds(found->finding.help, fmt::format("are the points in {}, not mm", unit.is)))
        << found->finding.help;
  }
}

TEST(GrossScale, OfATableInAnotherUnitIsThatOfTheTable) {
  SimulatedArm at = simulated_arm(4);
  for (auto& joint : at.cell.nominal.joints) joint.a *= 1e-3 / 0.3048, joint.d *= 1e-3 / 0.3048;
  const auto found = gross_of(at);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_unit);
  EXPECT_TRUE(holds(found->finding.help, "lengths of the DH table in ft, not mm"))
      << found->finding.help;
}

TEST(GrossScale, OfNoUnitIsTheFactorAlone) {
  for (const double factor : {0.6, 1.37, 17.0}) {
    SimulatedArm at = simulated_arm(5);
    at.measured.p_M /= factor;
    const auto found = gross_of(at);
    ASSERT_TRUE(found) << factor;
    EXPECT_FALSE(found->is_unit) << factor;
    EXPECT_NEAR(number_behind(found->finding.message, "by one factor, "), factor, 2e-3 * factor);
  }
}

TEST(GrossScale, IsNoneOfPointsThatFitAsTheyAreOrNotAtAll) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    EXPECT_FALSE(gross_of(simulated_arm(seed))) << seed;
  SimulatedArm mirrored = simulated_arm(5);
  mirrored.measured.p_M /= 1.37;
  mirrored.measured.p_M.col(0) *= -1.0;
  EXPECT_FALSE(gross_of(mirrored));
  SimulatedArm other = simulated_arm(5);
  other.measured.p_M /= 1.37;
  other.measured.q.col(2) *= -1.0;
  EXPECT_FALSE(gross_of(other));
}

}  // namespace
}  // namespace plumb::offline
