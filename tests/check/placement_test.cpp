// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "check/regularised_fit.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {
namespace {

/// An arm as its table says, seen without noise.
struct Placement : testing::Test {
  void SetUp() override { measure(0.0); }
  void measure(double error) {
    cell = random_cell(5, 6, format::Convention::kModified, ArmKind::kRevolute);
    SimulationPlan plan;
    plan.poses = 60;
    plan.noise_m = 0.0;
    plan.truth.geometry_m = plan.truth.geometry_rad = error;
    const Simulation simulation = simulate(cell, plan);
    measured = simulation.measured;
    truth.arm.calibrated = simulation.true_chain;
    truth.X_MB = simulation.X_MB;
    truth.X_TG = simulation.X_TG;
    rows.resize(60);
    std::iota(rows.begin(), rows.end(), 0);
  }
  double farthest(const ArmState& state) const {
    return (predict_points(state, measured) - predict_points(truth, measured))
        .rowwise()
        .norm()
        .maxCoeff();
  }

  Cell cell;
  Measurements measured;
  ArmState truth;
  std::vector<int> rows;
};

TEST_F(Placement, IsFoundFromTheLabelsThoughThreeReadingsAreWrongByDecimetres) {
  for (const Eigen::Index i : {4, 17, 40}) measured.p_M(i, 1) += 0.3;
  EXPECT_LT(farthest(placed_from_the_labels(cell, measured, rows).state), 1e-6);
}

TEST_F(Placement, OfAnExactLinearMapIsTheFrameItself) {
  const Eigen::Matrix3d R_MB =
      Eigen::Quaterniond(truth.X_MB.q[0], truth.X_MB.q[1], truth.X_MB.q[2], truth.X_MB.q[3])
          .toRotationMatrix();
  const ArmState near = state_near(cell, measured, rows, 3.0 * R_MB.transpose(),
                                   Eigen::Map<const Eigen::Vector3d>(truth.X_TG.p.data()));
  EXPECT_LT(farthest(near), 1e-9);
}

/// A real arm's errors of a millimetre and a milliradian are taken up; a joint that counts the
/// other way is not.
TEST_F(Placement, TheRegularisedFitTakesUpRealErrorsAndNoOtherArm) {
  measure(1e-3);
  const RegularisedFit placed = placed_from_the_labels(cell, measured, rows);
  EXPECT_GT(placed.rms_m, 3e-4);
  EXPECT_LT(regularised_fit(cell, measured, rows, placed.state).rms_m, 0.05 * placed.rms_m);
  measured.q.col(2) *= -1.0;
  const RegularisedFit wrong = placed_from_the_labels(cell, measured, rows);
  EXPECT_GT(regularised_fit(cell, measured, rows, wrong.state).rms_m, 0.01);
}

}  // namespace
}  // namespace plumb::offline
