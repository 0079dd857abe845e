// SPDX-License-Identifier: Apache-2.0
// Measured orientations in a diagnosis: their lines against differences of predicted orientations,
// and effects that they show where positions do not.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "arm/measured_arm.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/whitened_fit.hpp"
#include "fit/calibrate.hpp"
#include "fit/fit_cell.hpp"
#include "fit/verdict.hpp"
#include "noise/orientation_floor.hpp"
#include "simulate/simulate.hpp"
#include "simulate/study_arms.hpp"
#include "tests/diagnose/hiding.hpp"

namespace plumb::offline {
namespace {

constexpr double kNoise_m = 50e-6, kNoise_rad = 20e-6;

/// A heavy arm measured with its orientations.
struct Turned {
  explicit Turned(const std::vector<std::string>& hidden, double noise_rad = kNoise_rad,
                  int repeats = 3, std::uint64_t seed = 1) {
    cell = sim::heavy_arm();
    cell.tolerance_m = 0.3e-3;
    cell.measurement.sigma_m = kNoise_m;
    cell.measurement.sigma_rad = kNoise_rad;
    plan.poses = 150;
    plan.repeats = repeats;
    plan.noise_m = kNoise_m;
    plan.noise_rad = noise_rad;
    plan.seed = seed;
    plan.truth.geometry_m = 0.3e-3;
    plan.truth.geometry_rad = 0.3e-3;
    plan.truth.effects = hidden;
    static_cast<Measurements&>(measured) = simulate(cell, plan).measured;
  }

  Cell cell;
  SimulationPlan plan;
  MeasurementFiles measured;
};

TEST(OrientationLines, AreTheTurnOfTheReflectorPerUnitOfEachJoint) {
  constexpr double kStep = 1e-6;
  const Turned made({});
  std::vector<int> rows(static_cast<std::size_t>(made.measured.size()));
  std::iota(rows.begin(), rows.end(), 0);
  const Calibration fitted = calibrate(made.cell, made.measured, rows);
  const WhitenedFit s = make_whitened_fit(made.cell, made.measured, fitted, rows, {});
  ASSERT_EQ(s.table.count(0), 6) << "three of the point, three of the orientation";
  const MeasuredArm arm(fitted.state.arm);
  for (Eigen::Index i = 0; i < 20; ++i) {
    for (int j = 0; j < s.joints(); ++j) {
      std::vector<double> q(s.q(i).begin(), s.q(i).end());
      const Matrix3 before = arm.predict(q, {}).X_BT.R;
      q[static_cast<std::size_t>(j)] += kStep;
      const Vector3 turn_B =
          rotation_vector(arm.predict(q, {}).X_BT.R * before.transpose()) / kStep;
      Eigen::VectorXd lines = s.joint[static_cast<std::size_t>(j)].segment(s.table.begin(i), 6);
      unwhiten(s, i, lines);
      const Vector3 expected = s.X_MB[static_cast<std::size_t>(i)].R * turn_B;
      EXPECT_LT((lines.tail(3) - expected).norm(), 1e-6) << "joint " << j;
    }
  }
}

TEST(OrientationFloor, IsTheScatterOfRepeatsAndNotWhatTheModelLacks) {
  const Turned made({"gear_ripple:J6=300urad"});
  const OrientationFloor floor = orientation_floor(made.cell, made.measured);
  EXPECT_EQ(floor.source, NoiseFloor::Source::kRepeats);
  EXPECT_NEAR(floor.sigma_rad, kNoise_rad, 0.35 * kNoise_rad);
  EXPECT_NEAR(floor.mean_rad, 1.596 * floor.sigma_rad, 1e-3 * floor.sigma_rad);
  const Turned once({}, kNoise_rad, 1);
  EXPECT_EQ(orientation_floor(once.cell, once.measured).source, NoiseFloor::Source::kSigma);
  Turned rounded({});
  const std::vector<int>& group = rounded.measured.replicate_group;
  for (Eigen::Index i = 1; i < rounded.measured.size(); ++i)
    if (group[static_cast<std::size_t>(i)] == group[static_cast<std::size_t>(i - 1)])
      rounded.measured.quat_M.row(i) = rounded.measured.quat_M.row(i - 1);
  EXPECT_EQ(orientation_floor(rounded.cell, rounded.measured).source, NoiseFloor::Source::kSigma);
  Cell unused = made.cell;
  unused.measurement.sigma_rad.reset();
  EXPECT_FALSE(orientation_floor(unused, made.measured).known());
}

// The ripple moves the reflector by less than the tracker's noise; it turns the tool by six times
// the noise of its orientation.
TEST(DiagnoseOrientations, ARippleThatOnlyTurnsTheToolIsSeenByFitAndNamed) {
  const Turned made({"gear_ripple:J6=300urad"});
  const Fit fit = fit_cell(made.cell, made.measured);
  const std::string said = verdict(fit, made.cell.tolerance_m);
  EXPECT_EQ(quality(fit, made.cell.tolerance_m), Quality::kGoodButTurned) << said;
  EXPECT_TRUE(says(said, "something that turns the tool is missing")) << said;
  const Diagnosis found = diagnose(made.cell, made.measured, {.apply = true, .tell = {}});
  EXPECT_EQ(found.finding, Finding::kMissing) << found.text;
  ASSERT_FALSE(found.added.empty()) << found.text_after;
  EXPECT_EQ(found.added.front().entry.name, "gear_ripple") << found.text;
  EXPECT_EQ(found.added.front().entry.joints, std::vector<int>{5}) << found.text;
  EXPECT_TRUE(says(found.text, "on unseen poses, orientations 0.")) << found.text;
  ASSERT_TRUE(found.turns);
  EXPECT_LT(found.turns->after.mean, 0.3 * found.turns->before.mean) << found.text_after;
  EXPECT_LT(found.turns->excess->times, 1.3) << found.text_after;
  EXPECT_LE(found.after.mean, 1.05 * found.before.mean);
}

TEST(DiagnoseOrientations, NothingIsNamedWhereNothingTurnsTheTool) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Turned made({}, kNoise_rad, 3, seed);
    const Fit fit = fit_cell(made.cell, made.measured);
    EXPECT_EQ(quality(fit, made.cell.tolerance_m), Quality::kGood)
        << verdict(fit, made.cell.tolerance_m);
    const Diagnosis found = diagnose(made.cell, made.measured, {.apply = true, .tell = {}});
    EXPECT_EQ(found.finding, Finding::kComplete) << found.text;
    EXPECT_TRUE(found.added.empty()) << found.text_after;
  }
}

// An orientation that scatters by more than is stated is no effect of the arm.
TEST(DiagnoseOrientations, ScatterOfTheCameraIsNoEffectOfTheArm) {
  const Turned made({}, 1e-3);
  const Fit fit = fit_cell(made.cell, made.measured);
  EXPECT_EQ(quality(fit, made.cell.tolerance_m), Quality::kGood)
      << verdict(fit, made.cell.tolerance_m);
  const Diagnosis found = diagnose(made.cell, made.measured, {.apply = true, .tell = {}});
  EXPECT_TRUE(found.added.empty()) << found.text_after;
}

// A camera's orientations that are wrong by place, as those of a bent lens are: repeats agree, and
// no law of the arm is behind it. The points keep the arm's gravity and its error.
TEST(DiagnoseOrientations, ErrorsOfTheInstrumentAreNoCertainEffectOfTheArm) {
  for (const std::uint64_t seed : {1, 5, 7}) {
    Turned made({}, kNoise_rad, 3, seed);
    sim::state_masses(made.cell, 420.0);
    const Vector3 middle = made.measured.p_M.colwise().mean().transpose();
    for (Eigen::Index i = 0; i < made.measured.size(); ++i) {
      const Vector3 d = made.measured.p_M.row(i).transpose() - middle;
      const Vector3 turn =
          300e-6 * Vector3(d(0) * d(1), d(1) - d(2), std::sin(2.0 * d(0)) + 0.5 * d(2));
      const Eigen::Quaterniond was(made.measured.quat_M(i, 0), made.measured.quat_M(i, 1),
                                   made.measured.quat_M(i, 2), made.measured.quat_M(i, 3));
      const Eigen::Quaterniond is =
          Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * was;
      made.measured.quat_M.row(i) << is.w(), is.x(), is.y(), is.z();
    }
    const Fit fit = fit_cell(made.cell, made.measured);
    EXPECT_TRUE(says(verdict(fit, made.cell.tolerance_m), "errors of their own"))
        << verdict(fit, made.cell.tolerance_m);
    const Diagnosis found = diagnose(made.cell, made.measured, {.apply = true, .tell = {}});
    EXPECT_FALSE(found.gravity && found.gravity->certain) << found.text;
    EXPECT_LT(found.after.mean, 1.02 * found.before.mean) << found.text_after;
    EXPECT_NE(*found.finding_after, Finding::kComplete) << found.text_after;
  }
}

}  // namespace
}  // namespace plumb::offline
