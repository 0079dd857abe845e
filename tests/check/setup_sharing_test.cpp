// SPDX-License-Identifier: Apache-2.0
// Set-ups that are said to share a place or a reflector, and do or do not.
#include "check/setup_sharing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/check/simulated_arm.hpp"

namespace plumb::offline {
namespace {

using Place3 = std::array<double, 3>;
const format::Pose kStation{{1.5, -0.4, 0.3}, {0.8, 0.0, 0.36, 0.48}};
constexpr Place3 kReflector{0.06, -0.03, 0.12};

void append(const Measurements& more, int setup, MeasurementFiles& to) {
  const auto old = to.q.rows(), added = more.q.rows();
  to.q.conservativeResize(old + added, more.q.cols());
  to.q.bottomRows(added) = more.q;
  to.p_M.conservativeResize(old + added, 3);
  to.p_M.bottomRows(added) = more.p_M;
  for (Eigen::Index i = old; i < old + added; ++i) {
    to.pose.push_back(std::to_string(i + 1));
    to.replicate_group.push_back(static_cast<int>(i));
    to.set.push_back(SetMark::kUnmarked);
    to.setup.push_back(setup);
  }
}

/// Two days: on the second the tracker stands `moved` away, and the reflector sits so far off.
struct TwoDays {
  TwoDays(const Place3& moved, const Place3& other, int poses_of_second = 60) {
    cell = six_joint_cell(11);
    cell.measurement.sigma_m = 20e-6;
    cell.effects = {{"geometry", {}, {}, {}}};
    for (int day = 0; day < 2; ++day) {
      SimulationPlan plan = plan_of_arm(100 + day, day == 0 ? 60 : poses_of_second);
      plan.truth.seed = 7;
      plan.truth.X_MB = kStation;
      plan.truth.target_T = kReflector;
      for (std::size_t k = 0; k < 3 && day == 1; ++k) {
        plan.truth.X_MB->p[k] += moved[k];
        (*plan.truth.target_T)[k] += other[k];
      }
      append(simulate(cell, plan).measured, day, measured);
      Setup setup;
      setup.name = day == 0 ? "Monday" : "Tuesday";
      setup.place.line = 10 + day;
      cell.measurement.setups.push_back(setup);
    }
    for (int i = 0; i < measured.size(); ++i) rows.push_back(i);
  }
  Setup& second() { return cell.measurement.setups[1]; }
  std::vector<Problem> found() const { return sharing_findings(cell, measured, rows); }

  Cell cell;
  MeasurementFiles measured;
  std::vector<int> rows;
};

TwoDays sharing_frame(const Place3& moved) {
  TwoDays out(moved, {});
  out.second().frame_of = 0;
  out.second().fit_frame = false;
  return out;
}

TwoDays sharing_target(const Place3& other) {
  TwoDays out({}, other);
  out.second().target_of = 0;
  out.second().fit_target = false;
  return out;
}

double away_mm(const Problem& problem) {
  const std::string before = "with its own it is ";
  return std::atof(problem.message.c_str() + problem.message.find(before) + before.size());
}

TEST(SetupSharing, OfAPlaceThatHasMovedIsSaidWithTheDistance) {
  for (const Place3& moved : {Place3{2e-3, 0.0, 0.0}, Place3{-3e-3, 4e-3, 12e-3}}) {
    const auto found = sharing_frame(moved).found();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found.front().code, "W-CHECK-SAME");
    EXPECT_TRUE(
        holds(found.front().message, "set-up 'Tuesday' does not stand where 'Monday' stands"))
        << found.front().message;
    const double size = 1e3 * std::hypot(moved[0], moved[1], moved[2]);
    EXPECT_NEAR(away_mm(found.front()), size, 0.1 * size) << found.front().message;
    ASSERT_TRUE(found.front().place);
    EXPECT_EQ(found.front().place->line, 11);
    EXPECT_TRUE(holds(found.front().help, "'Tuesday': frame = \"fit\"")) << found.front().help;
  }
}

TEST(SetupSharing, OfAReflectorThatIsAnotherIsSaidWithTheDistance) {
  const auto found = sharing_target({5e-3, 0.0, -3e-3}).found();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(holds(found.front().message,
                    "set-up 'Tuesday' does not carry the reflector that 'Monday' carries"))
      << found.front().message;
  EXPECT_NEAR(away_mm(found.front()), std::hypot(5.0, 3.0), 0.6) << found.front().message;
  EXPECT_TRUE(holds(found.front().help, "target = \"fit\"")) << found.front().help;
}

TEST(SetupSharing, IsBelievedWhereItIsTrue) {
  EXPECT_TRUE(sharing_frame({}).found().empty());
  EXPECT_TRUE(sharing_target({}).found().empty());
  TwoDays both({}, {});
  both.second().frame_of = both.second().target_of = 0;
  both.second().fit_frame = both.second().fit_target = false;
  EXPECT_TRUE(both.found().empty());
}

TEST(SetupSharing, IsNoQuestionOfSetUpsThatShareNothing) {
  EXPECT_TRUE(TwoDays({0.5, 0.0, 0.0}, {0.02, 0.0, 0.0}).found().empty());
}

TEST(SetupSharing, IsNotJudgedByAFewRows) {
  TwoDays few({5e-3, 0.0, 0.0}, {}, 6);
  few.second().frame_of = 0;
  few.second().fit_frame = false;
  EXPECT_TRUE(few.found().empty());
}

TEST(SetupSharing, IsNoQuestionOfASingleSetUp) {
  const SimulatedArm one = simulated_arm(1);
  EXPECT_TRUE(sharing_findings(one.cell, one.measured, one.rows).empty());
}

}  // namespace
}  // namespace plumb::offline
