// SPDX-License-Identifier: Apache-2.0
#include "check/identifiability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numeric>

#include "check/spectrum.hpp"
#include "fit/cell_data.hpp"
#include "simulate/simulate.hpp"
#include "solve/evaluation.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {
namespace {

constexpr auto kStandard = format::Convention::kStandard;

std::vector<int> all_rows(const MeasurementFiles& m) {
  std::vector<int> rows(m.size());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

SimulationPlan plan_with(std::uint64_t seed) {
  SimulationPlan plan;
  plan.poses = 120;
  plan.seed = seed;
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.5e-3;
  return plan;
}

IdentifiabilityReport report(const Cell& cell, const MeasurementFiles& m) {
  return identifiability(cell, m, all_rows(m));
}

bool says(const IdentifiabilityReport& r, const std::string& parameter, Separation::Cause cause,
          const std::string& words) {
  for (const auto& s : r.separations)
    if (s.parameter == parameter && s.cause == cause && s.text.find(words) != std::string::npos)
      return true;
  for (const auto& s : r.separations) std::printf("  %s\n", s.text.c_str());
  return false;
}

// s = (8, 4, 1), 16 poses: by hand 32^(1/3)/4, 1/8, 1, 1/8, 1/(1/8 + 1/4 + 1) = 8/11.
TEST(Observability, MeetsTheClosedFormsOfThreeSingularValues) {
  const Observability o = observability(Eigen::Vector3d(8.0, 4.0, 1.0), 16);
  EXPECT_NEAR(o.O1, std::cbrt(32.0) / 4.0, 1e-14);
  EXPECT_NEAR(o.O2, 0.125, 1e-15);
  EXPECT_NEAR(o.O3, 1.0, 1e-15);
  EXPECT_NEAR(o.O4, 0.125, 1e-15);
  EXPECT_NEAR(o.O5, 8.0 / 11.0, 1e-14);
}

// A planar joint with a reflector at distance r seen n times evenly round the turn: its columns for
// radius and zero angle are orthogonal, with lengths sqrt(n) and r sqrt(n).
TEST(Observability, OfATurningReflectorIsThatOfItsTwoOrthogonalColumns) {
  const int n = 12;
  const double r = 0.5;
  Eigen::MatrixXd J(2 * n, 2);
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * M_PI * i / n;
    J.row(2 * i) << std::cos(a), -r * std::sin(a);
    J.row(2 * i + 1) << std::sin(a), r * std::cos(a);
  }
  const Observability o = observability(singular_values(J), n);
  EXPECT_NEAR(o.O1, std::sqrt(r), 1e-12);
  EXPECT_NEAR(o.O2, r, 1e-12);
  EXPECT_NEAR(o.O3, r * std::sqrt(n), 1e-12);
  EXPECT_NEAR(o.O4, r * r * std::sqrt(n), 1e-12);
  EXPECT_NEAR(o.O5, std::sqrt(n) / (1.0 + 1.0 / r), 1e-12);
  EXPECT_NEAR(spectrum(J).condition, 1.0, 1e-12);
}

/// Derivatives of three reflectors seen at the same poses, each with a place of its own: complete
/// link twists and the frame shared, three columns more for each.
Eigen::MatrixXd seen_through_three(const Cell& cell, const Simulation& s) {
  const auto parameters = candidate_parameters(cell, Orientation::kIgnored);
  const auto count = static_cast<Eigen::Index>(parameters.size());
  FitData data;
  data.measured = &s.measured;
  data.rows = all_rows(s.measured);
  data.sigma_m = Rows3::Ones(s.measured.size(), 3);
  const Eigen::Index rows = data.residual_count();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * rows, count + 6);
  for (int k = 0; k < 3; ++k) {
    ArmState state;
    state.arm.calibrated = cell.nominal;
    state.X_TG.p = {0.1 * (k == 0), 0.12 * (k == 1), 0.05 + 0.09 * (k == 2)};
    Eigen::MatrixXd J = evaluate(data, state, parameters).jacobian;
    for (Eigen::Index c = 0; c < count; ++c) {
      const auto& p = parameters[c];
      const bool target = p.kind == Parameter::Kind::kTarget;
      const Eigen::Index column = target && k > 0 ? count + 3 * (k - 1) + p.component : c;
      out.block(k * rows, column, rows, 1) = J.col(c);
    }
  }
  return out;
}

TEST(Identifiability, ASixJointArmHasRankTwentySevenThroughOnePointAndThirtyThreeThroughThree) {
  for (const auto model : {FitSettings::Model::kDh, FitSettings::Model::kComplete}) {
    Cell cell = random_cell(1, 6, kStandard, ArmKind::kRevolute);
    cell.fit.model = model;
    const Simulation s = simulate(cell, plan_with(1));
    EXPECT_EQ(report(cell, s.measured).rank, 27);
    EXPECT_EQ(spectrum(seen_through_three(cell, s)).rank, 33);
  }
}

TEST(Identifiability, AgreesWithTheRankOfTheFitOnRandomArms) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Cell cell =
        random_cell(seed, 4 + static_cast<int>(seed) % 4, kStandard, ArmKind::kRevolute);
    const auto r = report(cell, simulate(cell, plan_with(seed)).measured);
    EXPECT_EQ(r.rank, r.calibration.rank) << "seed " << seed;
    EXPECT_GE(r.scaled_condition, 1.0);
  }
}

TEST(Separation, NamesParallelNeighboursWithTheirAngle) {
  Cell cell;
  for (std::uint64_t seed = 1; !cell.mechanics.empty() ? !cell.mechanics[1].parallel_next : true;
       ++seed)
    cell = random_cell(seed, 6, kStandard, ArmKind::kRevolute);
  const auto r = report(cell, simulate(cell, plan_with(3)).measured);
  EXPECT_TRUE(says(r, "J2.d", Separation::Cause::kArm,
                   "J2.d and J3.d cannot be separated: J2 and J3 are parallel to 0.0"));
}

TEST(Separation, TellsWhatOnlyTheFrameOrTheTargetRepeatsFromWhatPosesWouldShow) {
  const Cell cell = random_cell(2, 6, kStandard, ArmKind::kRevolute);
  const auto r = report(cell, simulate(cell, plan_with(2)).measured);
  EXPECT_TRUE(says(r, "J1.theta", Separation::Cause::kChoice, "the fitted frame carries it"));
  EXPECT_TRUE(says(r, "J6.theta", Separation::Cause::kChoice, "the fitted target carries it"));
  for (const auto& s : r.separations) EXPECT_NE(s.cause, Separation::Cause::kPoses) << s.text;
}

TEST(Separation, SaysThatAJointNeverMoves) {
  const Cell cell = random_cell(2, 6, kStandard, ArmKind::kRevolute);
  for (const int still : {2, 3, 5}) {
    SimulationPlan plan = plan_with(2);
    plan.q = simulate(cell, plan).measured.q;
    plan.q.col(still).setConstant(0.3);
    const auto r = report(cell, simulate(cell, plan).measured);
    int said = 0;
    for (const auto& s : r.separations)
      said += s.text.find(cell.nominal.joints[still].name + " never moves") != std::string::npos;
    EXPECT_GT(said, 0) << "joint " << still + 1;
  }
}

TEST(Separation, SaysThatTheReflectorIsOnTheLastAxis) {
  Cell cell = random_cell(2, 6, kStandard, ArmKind::kRevolute);
  SimulationPlan plan = plan_with(2);
  plan.truth.target_T = {0.0002, 0.0, 0.05};
  const auto r = report(cell, simulate(cell, plan).measured);
  int said = 0;
  for (const auto& s : r.separations)
    said += s.text.find("mm from the axis of J6") != std::string::npos;
  EXPECT_GT(said, 0);
  for (const auto& s : r.separations) std::printf("  %s\n", s.text.c_str());
}

TEST(Separation, ExplainsTheNearDegenerateNumbersOfARealArm) {
  const std::filesystem::path folder = PLUMB_SHARED_DATA;
  if (!std::filesystem::exists(folder / "cell.toml")) GTEST_SKIP() << "no " << folder;
  Cell cell = read_cell(folder / "cell.toml");
  const MeasurementFiles m = read_cell_measurements(cell);
  const auto r = report(cell, m);
  EXPECT_EQ(r.rank, 27);
  int said = 0;
  for (const auto& s : r.separations)
    if (s.text.find("J5.a") != std::string::npos)
      said += s.text.find("from the axis of J6") != std::string::npos;
  EXPECT_GT(said, 0);
  for (const auto& s : r.separations) std::printf("  %s\n", s.text.c_str());
}

}  // namespace
}  // namespace plumb::offline
