// SPDX-License-Identifier: Apache-2.0
#include "check/row_pattern.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "arm/predicted_points.hpp"
#include "check/tool_errors.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {
namespace {

/// Readings whose errors are noise of 20 um and what a test adds.
struct RowPattern {
  explicit RowPattern(std::uint64_t seed)
      : cell(random_cell(seed, 5, format::Convention::kStandard, ArmKind::kRevolute)) {
    SimulationPlan plan;
    plan.poses = 120;
    plan.seed = seed;
    plan.noise_m = 20e-6;
    plan.truth.geometry_m = plan.truth.geometry_rad = 0.0;
    const Simulation simulation = simulate(cell, plan);
    measured = simulation.measured;
    state.arm.calibrated = simulation.true_chain;
    state.X_MB = simulation.X_MB;
    state.X_TG = simulation.X_TG;
  }
  std::vector<Problem> findings() const {
    std::vector<int> rows(static_cast<std::size_t>(measured.size()));
    std::iota(rows.begin(), rows.end(), 0);
    return pattern_findings(measured, rows, state);
  }
  /// Every `period`-th reading is of another reflector, or of another station.
  void shift(int period, bool in_tool) {
    ArmState other = state;
    (in_tool ? other.X_TG : other.X_MB).p[1] += 1e-4;
    const Rows3 off = predict_points(other, measured) - predict_points(state, measured);
    for (Eigen::Index i = 2 % period; i < measured.size(); i += period)
      measured.p_M.row(i) += off.row(i);
  }

  Cell cell;
  MeasurementFiles measured;
  ArmState state;
};

TEST(PatternOfRows, TheShortestPeriodAndItsAxesAreNamed) {
  const char* const every[] = {"second", "third", "fourth", "fifth"};
  for (int period = 2; period <= 5; ++period)
    for (const bool in_tool : {false, true}) {
      RowPattern at(static_cast<std::uint64_t>(period));
      at.shift(period, in_tool);
      const auto found = at.findings();
      ASSERT_EQ(found.size(), 1U) << period;
      EXPECT_NE(found[0].message.find(std::string("every ") + every[period - 2] + " reading"),
                std::string::npos)
          << found[0].message;
      EXPECT_NE(found[0].message.find(in_tool ? "axes of the tool" : "axes of the tracker"),
                std::string::npos)
          << found[0].message;
    }
}

/// One in 10^5 by chance, eleven periods and two frames a file.
TEST(PatternOfRows, NoiseHasNone) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
    EXPECT_TRUE(RowPattern(seed).findings().empty()) << seed;
}

TEST(PatternOfRows, IsSilentWhereAJointFollowsIt) {
  RowPattern at(2);
  const Rows3 before = predict_points(at.state, at.measured);
  for (Eigen::Index i = 0; i < at.measured.size(); ++i)
    at.measured.q(i, 3) = (i % 2 == 0 ? 1.0 : -1.0) * std::abs(at.measured.q(i, 3));
  at.measured.p_M += predict_points(at.state, at.measured) - before;
  at.shift(2, false);
  EXPECT_TRUE(at.findings().empty());
}

}  // namespace
}  // namespace plumb::offline
