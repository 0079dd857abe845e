// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "check/arm_shape.hpp"
#include "check/coverage.hpp"
#include "check/tool_errors.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

/// What is said of an arm and its poses before any fitting.
namespace plumb::offline {
namespace {

struct ArmPoses : testing::Test {
  explicit ArmPoses(std::uint64_t seed = 3)
      : cell(random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute)) {
    SimulationPlan plan;
    plan.poses = 40;
    plan.seed = seed;
    Simulation simulation = simulate(cell, plan);
    measured = simulation.measured;
    state.arm.calibrated = cell.nominal;
    state.X_MB = simulation.X_MB;
    state.X_TG = simulation.X_TG;
    rows.resize(static_cast<std::size_t>(measured.size()));
    std::iota(rows.begin(), rows.end(), 0);
  }

  Cell cell;
  Measurements measured;
  ArmState state;
  std::vector<int> rows;
};

/// Turned by phi, a point at the distance r of the axis moves by 2 r sin(phi / 2).
TEST_F(ArmPoses, TheReflectorIsAsFarOffTheLastAxisAsTurningItMovesThePoint) {
  Measurements turned = measured;
  turned.q.col(5).array() += 0.5;
  const double moved =
      (predict_points(state, turned) - predict_points(state, measured)).rowwise().norm().maxCoeff();
  const ArmShape shape = arm_shape(cell, measured, rows, state);
  EXPECT_GT(shape.reflector_off_last_axis_m, 1e-3);
  EXPECT_NEAR(shape.reflector_off_last_axis_m, moved / (2.0 * std::sin(0.25)), 1e-9);
}

/// By the table: alpha is the angle between two axes, whichever way they point.
TEST_F(ArmPoses, AnglesBetweenAxesAreThoseOfTheTable) {
  for (double alpha = -3.0; alpha < 3.1; alpha += 0.7) {
    state.arm.calibrated.joints[2].alpha = alpha;
    const ArmShape shape = arm_shape(cell, measured, rows, state);
    const double angle = std::abs(alpha);
    EXPECT_NEAR(shape.angle_to_next[2], std::min(angle, M_PI - angle), 1e-9) << alpha;
  }
}

TEST_F(ArmPoses, PointsAreFlatToOnePercentOfTheirSpreadInAnyPlane) {
  EXPECT_FALSE(arm_shape(cell, measured, rows, state).flat);
  const Eigen::RowVector3d normal = Eigen::RowVector3d(1.0, -2.0, 0.5).normalized();
  const Eigen::VectorXd height = measured.p_M * normal.transpose();
  for (const double share : {0.0, 0.003, 0.1}) {
    Measurements pressed = measured;
    pressed.p_M -= (1.0 - share) * height * normal;
    EXPECT_EQ(arm_shape(cell, pressed, rows, state).flat, share < 0.01) << share;
  }
}

TEST_F(ArmPoses, EveryReadingIsInOneTenthOfTheRangeOfEachJoint) {
  const Coverage all = coverage(cell, measured, rows, state);
  EXPECT_EQ(all.readings, measured.size());
  for (std::size_t j = 0; j < all.joints.size(); ++j) {
    const auto& tenths = all.joints[j].tenths;
    EXPECT_EQ(std::accumulate(tenths.begin(), tenths.end(), 0), measured.size());
    EXPECT_GT(tenths.front(), 0);
    EXPECT_GT(tenths.back(), 0);
    const auto& row = cell.nominal.joints[j];
    const auto q = measured.q.col(static_cast<Eigen::Index>(j));
    EXPECT_NEAR(all.joints[j].share, (q.maxCoeff() - q.minCoeff()) / (row.q_max - row.q_min),
                1e-12);
  }
}

TEST_F(ArmPoses, TheBoxIsOfTheBaseFrameWhereverTheTrackerStands) {
  const Coverage before = coverage(cell, measured, rows, state);
  state.X_MB = {{5.0, -1.0, 2.0}, {0.5, 0.5, 0.5, 0.5}};
  const Coverage after = coverage(cell, measured, rows, state);
  EXPECT_EQ(before.box_min, after.box_min);
  state.X_MB = format::Pose{};
  const Rows3 points = predict_points(state, measured);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(after.box_min[static_cast<std::size_t>(k)], points.col(k).minCoeff(), 1e-12);
    EXPECT_NEAR(after.box_max[static_cast<std::size_t>(k)], points.col(k).maxCoeff(), 1e-12);
  }
}

TEST_F(ArmPoses, AHoleInTheRangeIsNamedByItsEnds) {
  for (Eigen::Index i = 0; i < measured.size(); ++i)
    measured.q(i, 1) = (i % 2 == 0 ? -60.0 : 40.0 + static_cast<double>(i)) * M_PI / 180.0;
  measured.q.col(2).setConstant(0.5);
  const Coverage all = coverage(cell, measured, rows, state);
  EXPECT_EQ(all.joints[1].text, "nothing between -60 deg and 41 deg");
  EXPECT_EQ(all.joints[2].text, "never moves, it stays at 29 deg");
}

/// A reflector that sits elsewhere errs by one vector in the frame of the tool.
TEST_F(ArmPoses, ErrorsOfAMovedReflectorAreOneVectorInTheTool) {
  ArmState moved = state;
  const Eigen::RowVector3d shift(1e-3, -2e-3, 5e-4);
  for (int k = 0; k < 3; ++k) moved.X_TG.p[static_cast<std::size_t>(k)] += shift(k);
  const Rows3 errors = predict_points(moved, measured) - predict_points(state, measured);
  EXPECT_GT((errors.rowwise() - errors.row(0)).norm(), 1e-3);
  EXPECT_LT((errors_in_tool(state, measured, errors).rowwise() - shift).norm(), 1e-12);
}

}  // namespace
}  // namespace plumb::offline
