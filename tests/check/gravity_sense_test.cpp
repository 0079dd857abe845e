// SPDX-License-Identifier: Apache-2.0
// Where the weight of the arm points, by the cell file and by the points.
#include "check/gravity_sense.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/check/simulated_arm.hpp"

namespace plumb::offline {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kG = 9.81;
using Direction = std::array<double, 3>;

/// An arm whose joints yield under a weight that really points along `truth`.
SimulatedArm yielding(std::uint64_t seed, const Direction& truth,
                      const std::vector<std::string>& effects) {
  Cell cell = six_joint_cell(seed);
  cell.gravity = truth;
  cell.effects = {{"geometry", {}, {}, {}}};
  SimulationPlan plan = plan_of_arm(seed, 150);
  plan.truth.effects = effects;
  plan.truth.richness = 0.0;
  return measured_by(std::move(cell), plan);
}

const std::vector<std::string> kSoftJoints = {"joint_compliance:J2=2mrad,J3=2mrad"};

/// What is said if the cell file states that direction.
std::vector<Problem> said_of(SimulatedArm at, const Direction& stated) {
  at.cell.gravity = stated;
  return gravity_findings(at.cell, at.measured, at.rows, calibrate(at.cell, at.measured, at.rows));
}

/// The arm bends by nothing; only what the file says counts.
std::vector<Problem> note_of(const Direction& stated) {
  static const SimulatedArm stiff = yielding(1, {0.0, 0.0, -kG}, {});
  static const Calibration fitted = calibrate(stiff.cell, stiff.measured, stiff.rows);
  Cell cell = stiff.cell;
  cell.gravity = stated;
  return gravity_findings(cell, stiff.measured, stiff.rows, fitted);
}

Direction tilted(double angle, double towards) {
  return {kG * std::sin(angle) * std::cos(towards), kG * std::sin(angle) * std::sin(towards),
          -kG * std::cos(angle)};
}

TEST(GravityNote, IsSaidOfEveryTiltAndOfNoUprightArm) {
  for (const double towards : {0.0, 0.7, 2.0, 4.5}) {
    EXPECT_TRUE(note_of(tilted(0.0, towards)).empty());
    EXPECT_TRUE(note_of(tilted(1.0 * kDegree, towards)).empty());
    for (const double degrees : {5.0, 30.0, 45.0, 70.0, 120.0}) {
      const auto found = note_of(tilted(degrees * kDegree, towards));
      ASSERT_EQ(found.size(), 1U) << degrees;
      EXPECT_EQ(found.front().severity, Severity::kNote);
      EXPECT_TRUE(holds(found.front().message, fmt::format("{:.0f} deg off -z", degrees)))
          << found.front().message;
    }
    EXPECT_TRUE(holds(note_of(tilted(M_PI_2, towards)).front().message, "mounted on a wall"));
    EXPECT_TRUE(holds(note_of(tilted(M_PI, towards)).front().message, "head down"));
  }
}

TEST(GravityNote, DependsOnTheDirectionAndNotOnTheSize) {
  for (const double size : {0.01, 1.62, 98.1}) {
    EXPECT_TRUE(note_of({0.0, 0.0, -size}).empty()) << size;
    EXPECT_TRUE(holds(note_of({0.0, 0.0, size}).front().message, "head down")) << size;
  }
}

TEST(GravityNote, OfNoGravitySaysThatNoLoadCanBeFound) {
  const auto found = note_of({0.0, 0.0, 0.0});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(holds(found.front().message, "no effect of a load can be found"));
}

TEST(GravityWarning, NamesTheDirectionUnderWhichTheJointsReallyYield) {
  const Direction down{0.0, 0.0, -kG};
  struct Truth {
    Direction along;
    std::string words;
  };
  int named = 0;
  for (const Truth& truth :
       {Truth{{kG, 0.0, 0.0}, "along [9.81, 0, 0]"}, Truth{{0.0, -kG, 0.0}, "along [0, -9.81, 0]"},
        Truth{{0.0, 0.0, kG}, "along [0, 0, 9.81]"}})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto found = said_of(yielding(seed, truth.along, kSoftJoints), down);
      for (const Problem& problem : found) {
        EXPECT_EQ(problem.code, "W-CHECK-GRAVITY");
        EXPECT_TRUE(holds(problem.message, truth.words)) << seed << " " << problem.message;
        ++named;
      }
    }
  std::printf("%d of nine named\n", named);
  EXPECT_GE(named, 2);
}

TEST(GravityWarning, IsNeverSaidOfTheDirectionThatIsRight) {
  for (const Direction& truth :
       {Direction{0.0, 0.0, -kG}, Direction{kG, 0.0, 0.0}, Direction{0.0, 0.0, kG}})
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
      for (const auto& effects :
           {kSoftJoints, std::vector<std::string>{}, {"gear_harmonics:J2=1mrad,J3=1mrad"}})
        for (const Problem& problem : said_of(yielding(seed, truth, effects), truth))
          EXPECT_NE(problem.code, "W-CHECK-GRAVITY") << seed << " " << problem.message;
}

TEST(GravityWarning, IsNotSaidWhereTheModelHasEffectsOfItsOwn) {
  SimulatedArm at = yielding(1, {kG, 0.0, 0.0}, kSoftJoints);
  const Direction down{0.0, 0.0, -kG};
  ASSERT_FALSE(said_of(at, down).empty());
  at.cell.effects.push_back({"joint_compliance", {}, {}, {}});
  EXPECT_TRUE(said_of(at, down).empty());
}

}  // namespace
}  // namespace plumb::offline
