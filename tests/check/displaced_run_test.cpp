// SPDX-License-Identifier: Apache-2.0
#include "check/displaced_run.hpp"

#include <gtest/gtest.h>

#include <string>

#include "check/check.hpp"
#include "check/row_lines.hpp"
#include "plumb/runtime/chain.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/random_numbers.hpp"

/// Neighbouring readings that lie off by one vector, and some that do not.
namespace plumb::offline {
namespace {

constexpr int kFirst = 40, kLast = 47;  // rows that are spoilt

struct Case {
  Cell cell;
  MeasurementFiles measured;
};

Case sound(std::uint64_t seed) {
  Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = 120;
  plan.seed = seed;
  plan.noise_m = 20e-6;
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.3e-3;
  MeasurementFiles measured = simulate(cell, plan).measured;
  return {std::move(cell), std::move(measured)};
}

/// Orientation of the tool at a row, in the measurement frame, by the arm that was fitted.
Matrix3 orientation(const ArmState& state, const MeasurementFiles& measured, int row) {
  const std::span<const double> q(measured.q.row(row).data(), 6);
  return from_pose(state.X_MB).R * Chain(state.arm.calibrated).forward(q).R;
}

const Problem& outliers(const Check& check) {
  static const Problem none;
  for (const auto& problem : check.findings)
    if (problem.code == "W-CHECK-OUTLIER") return problem;
  return none;
}

std::string lines(const MeasurementFiles& measured) {
  return "lines " + std::to_string(line_of_row(measured, kFirst)) + " to " +
         std::to_string(line_of_row(measured, kLast)) + " are all off by some ";
}

TEST(DisplacedRun, AReflectorInAnotherPlaceIsSaidWithItsLinesAndItsVector) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Case at = sound(seed);
    const Check before = check_cell(at.cell, at.measured);
    ASSERT_TRUE(before.parameters) << seed;
    const ArmState state = before.parameters->calibration.state;
    for (int row = kFirst; row <= kLast; ++row)
      at.measured.p_M.row(row) +=
          (orientation(state, at.measured, row) * Vector3(0.02, -0.01, 0.03)).transpose();
    const Check check = check_cell(at.cell, at.measured);
    const std::string& said = outliers(check).message;
    EXPECT_NE(said.find(lines(at.measured)), std::string::npos) << seed << " " << said;
    EXPECT_NE(said.find("(20.0, -10.0, 30.0) mm, seen from the tool: the reflector"),
              std::string::npos)
        << seed << " " << said;
  }
}

TEST(DisplacedRun, ATrackerThatStoodElsewhereIsSaid) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Case at = sound(seed);
    for (int row = kFirst; row <= kLast; ++row)
      at.measured.p_M.row(row) += Eigen::RowVector3d(0.02, -0.01, -4e-6);
    const Check check = check_cell(at.cell, at.measured);
    const std::string& said = outliers(check).message;
    EXPECT_NE(said.find(lines(at.measured)), std::string::npos) << seed << " " << said;
    EXPECT_NE(said.find("(20.0, -10.0, 0.0) mm, seen from the tracker"), std::string::npos)
        << seed << " " << said;
  }
}

TEST(DisplacedRun, NeighboursThatAreOffEachInItsOwnWayAreNoRun) {
  tests::Random random(1);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Case at = sound(seed);
    for (int row = kFirst; row <= kLast; ++row)
      for (int k = 0; k < 3; ++k) at.measured.p_M(row, k) += random.uniform(-0.04, 0.04);
    const Check check = check_cell(at.cell, at.measured);
    const std::string& said = outliers(check).message;
    EXPECT_NE(said.find("contradicted by the others"), std::string::npos) << seed << " " << said;
    EXPECT_EQ(said.find("are all off"), std::string::npos) << seed << " " << said;
  }
}

TEST(DisplacedRun, TwoReadingsOrRowsFarApartAreNoRun) {
  Case at = sound(1);
  for (const int row : {10, 11, 40, 70, 100})
    at.measured.p_M.row(row) += Eigen::RowVector3d(0.02, -0.01, 0.03);
  const std::string said = outliers(check_cell(at.cell, at.measured)).message;
  EXPECT_NE(said.find("5 readings are contradicted"), std::string::npos) << said;
  EXPECT_EQ(said.find("are all off"), std::string::npos) << said;
}

}  // namespace
}  // namespace plumb::offline
