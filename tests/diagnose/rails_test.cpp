// SPDX-License-Identifier: Apache-2.0
// Rails and coupled drives. The simulator moves the arm to positions that its controller does not
// record, by formulas of this file: the library's laws have no part in what is measured.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "diagnose/diagnosis.hpp"
#include "plumb/runtime/transform.hpp"
#include "simulate/arm_rows.hpp"
#include "simulate/simulate.hpp"
#include "simulate/study_arms.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

using format::JointType;
using tests::Random;

constexpr int kPoses = 150;

/// Three rails at right angles and a wrist of two joints.
Cell gantry() {
  return sim::cell_from_sheet(
      format::Convention::kModified,
      {{.q_min = -900, .q_max = 900, .type = JointType::kPrismatic},
       {.alpha_deg = -90,
        .theta_deg = 90,
        .q_min = -1200,
        .q_max = 1200,
        .type = JointType::kPrismatic},
       {.alpha_deg = 90, .q_min = -500, .q_max = 500, .type = JointType::kPrismatic},
       {.alpha_deg = 90, .d_mm = 150, .q_min = -170, .q_max = 170},
       {.alpha_deg = -90, .d_mm = 80, .q_min = -120, .q_max = 120}},
      120);
}

struct Measured {
  Cell cell;
  Simulation simulation;
  Measurements& rows() { return simulation.measured; }
};

/// The arm with errors of its geometry at random positions; what it records is what it does.
Measured measured(Cell cell, std::uint64_t seed) {
  Random dice(seed);
  SimulationPlan plan;
  plan.q.resize(kPoses, cell.joints());
  for (Eigen::Index i = 0; i < plan.q.rows(); ++i)
    for (int j = 0; j < cell.joints(); ++j) {
      const auto& limits = cell.nominal.joints[static_cast<std::size_t>(j)];
      plan.q(i, j) = dice.uniform(limits.q_min, limits.q_max);
    }
  plan.poses = kPoses;
  plan.repeats = 3;
  plan.noise_m = 15e-6;
  plan.directions = Recorded::kAlways;
  plan.seed = plan.truth.seed.emplace(seed);
  plan.truth.geometry_m = 0.3e-3;
  plan.truth.geometry_rad = 0.3e-3;
  cell.measurement.sigma_m = plan.noise_m;
  return {cell, simulate(cell, plan)};
}

Diagnosis diagnosed(const Measured& arm) {
  Diagnosis out = diagnose(arm.cell, arm.simulation.measured, {.apply = true, .tell = {}});
  std::printf("%s\n  %s\n", out.text.c_str(), out.text_after.c_str());
  return out;
}

bool is(const EffectEntry& entry, const std::string& name, const std::vector<int>& joints) {
  return entry.name == name && entry.joints == joints;
}

const CandidateNumber& only_number(const Diagnosis& d) {
  return d.candidates.front().numbers.at(0);
}

/// A rail over two supports sags by `sag_m` in the middle, and swings once to either side. What
/// stands on it follows its slope.
void bend_rail(double sag_m, double swing_m, double half_m, Measured& arm) {
  const Transformd X_MB = from_pose(arm.simulation.X_MB);
  for (Eigen::Index i = 0; i < arm.rows().q.rows(); ++i) {
    const double q = arm.rows().q(i, 0), turn = std::numbers::pi * q / half_m;
    const Vector3 carriage(0.0, q, 0.0);  // the track lies along y of the base
    const Vector3 shift(swing_m * std::sin(turn), 0.0, -sag_m * std::cos(0.5 * turn));
    const double aside = swing_m * std::numbers::pi / half_m * std::cos(turn);
    const double up = sag_m * 0.5 * std::numbers::pi / half_m * std::sin(0.5 * turn);
    const Eigen::Matrix3d R =
        (Eigen::AngleAxisd(-aside, Vector3::UnitZ()) * Eigen::AngleAxisd(up, Vector3::UnitX()))
            .toRotationMatrix();
    const Vector3 p_B = X_MB.inverse() * Vector3(arm.rows().p_M.row(i).transpose());
    const Vector3 bent_B = carriage + shift + R * (p_B - carriage);
    arm.rows().p_M.row(i) = (X_MB * bent_B).transpose();
  }
}

TEST(DiagnoseRails, ABentTrackIsNamedAndTakenOut) {
  Measured arm = measured(sim::track_arm(), 3);
  bend_rail(0.15e-3, 0.03e-3, 1.5, arm);
  const Diagnosis d = diagnosed(arm);
  ASSERT_EQ(d.finding, Finding::kMissing) << d.text;
  EXPECT_TRUE(is(d.candidates.front().entry, "rail_bow", {0})) << d.text;
  EXPECT_NE(d.text.find("the rail of J1 is not straight"), std::string::npos) << d.text;
  EXPECT_EQ(d.effects.size(), arm.cell.effects.size() + 1) << d.text_after;
  EXPECT_LT(d.after.mean, 0.4 * d.before.mean);
}

/// One rail that is too long, and a tracker whose unit of length is too short, measure the same.
/// Hardly any tracker is so far off, so the rail leads; the list says what else looks like it.
TEST(DiagnoseRails, TheScaleOfTheOnlyRailIsLikeThatOfTheTracker) {
  Measured arm = measured(sim::track_arm(), 4);
  arm.rows().q.col(0) /= 1.0 + 120e-6;
  const Diagnosis d = diagnosed(arm);
  ASSERT_FALSE(d.candidates.empty()) << d.text;
  EXPECT_TRUE(is(d.candidates.front().entry, "encoder_scale", {0})) << d.text;
  EXPECT_NEAR(only_number(d).value, 120e-6, 12e-6);
  const auto& like = d.candidates.front().confounded_with;
  EXPECT_NE(std::find(like.begin(), like.end(), "tracker"), like.end()) << d.text;
}

TEST(DiagnoseRails, TheScaleOfOneRailOfThreeIsCertain) {
  Measured arm = measured(gantry(), 5);
  arm.rows().q.col(1) /= 1.0 + 120e-6;
  const Diagnosis d = diagnosed(arm);
  ASSERT_EQ(d.finding, Finding::kMissing) << d.text;
  EXPECT_TRUE(is(d.candidates.front().entry, "encoder_scale", {1})) << d.text;
  EXPECT_TRUE(d.alternatives.empty()) << d.text;
  EXPECT_NE(d.text.find("the scale of J2 is wrong"), std::string::npos) << d.text;
  EXPECT_NEAR(only_number(d).value, 120e-6, 12e-6);
}

/// A pinion beside its axis, with a little of its third harmonic.
TEST(DiagnoseRails, APeriodicErrorOfARackIsNamedWithItsPitch) {
  Measured arm = measured(sim::track_arm(), 9);
  for (double& q : arm.rows().q.col(0)) {
    const double phase = 2.0 * std::numbers::pi * q / 0.2356;
    q -= 60e-6 * std::sin(phase + 0.7) + 6e-6 * std::sin(3.0 * phase);
  }
  const Diagnosis d = diagnosed(arm);
  ASSERT_EQ(d.finding, Finding::kMissing) << d.text;
  const EffectEntry& first = d.candidates.front().entry;
  EXPECT_TRUE(is(first, "pitch_error", {0})) << d.text;
  ASSERT_TRUE(first.options.contains("pitch_mm")) << d.text;
  EXPECT_NEAR(std::get<double>(first.options.at("pitch_mm")), 235.6, 1.5);
  EXPECT_LT(d.after.mean, 0.7 * d.before.mean);
}

/// Play of an arm that always stops behind the flank it is pushed by.
void add_play(int joint, double half_gap, Measured& arm) {
  arm.rows().q.col(joint) += half_gap * arm.rows().context.direction.col(joint);
}

TEST(DiagnoseRails, PlayOfARailIsAReversalInMillimetres) {
  for (const auto& [cell, joint] :
       {std::pair{sim::track_arm(), 0}, std::pair{sim::scara_arm(), 2}}) {
    Measured arm = measured(cell, 6);
    add_play(joint, 40e-6, arm);
    const Diagnosis d = diagnosed(arm);
    ASSERT_EQ(d.finding, Finding::kMissing) << d.text;
    EXPECT_TRUE(is(d.candidates.front().entry, "reversal", {joint})) << d.text;
    EXPECT_NE(d.text.find("by its play"), std::string::npos) << d.text;
    EXPECT_NEAR(only_number(d).value, 40e-6, 6e-6);
    EXPECT_EQ(only_number(d).unit, std::string("m"));
    EXPECT_TRUE(d.candidates.front().entry.options.contains("transition_mm"));
    EXPECT_LT(d.after.mean, 0.8 * d.before.mean);
  }
}

/// The drive of joint `driving` moves joint `driven`, and the controller does not know.
TEST(DiagnoseRails, ACoupledDriveIsNamedWithBothJoints) {
  struct Coupled {
    Cell cell;
    int driven, driving;
    double share;
  };
  for (const auto& [cell, driven, driving, share] :
       {Coupled{sim::palletiser_arm(), 2, 1, 250e-6}, Coupled{sim::scara_arm(), 2, 3, 50e-6},
        Coupled{sim::heavy_arm(), 2, 1, 250e-6}}) {
    Measured arm = measured(cell, 7);
    arm.rows().q.col(driven) -= share * arm.rows().q.col(driving);
    const Diagnosis d = diagnosed(arm);
    ASSERT_EQ(d.finding, Finding::kMissing) << d.text;
    EXPECT_TRUE(is(d.candidates.front().entry, "drive_coupling", {driven, driving})) << d.text;
    EXPECT_NEAR(only_number(d).value, share, 0.1 * share);
    EXPECT_EQ(only_number(d).unit, std::string(driven == 2 && driving == 3 ? "m/rad" : "1"));
  }
}

TEST(DiagnoseRails, NothingIsNamedWhereNothingIsHidden) {
  for (const Cell& cell : {sim::track_arm(), sim::scara_arm(), sim::palletiser_arm(), gantry()}) {
    const Measured arm = measured(cell, 8);
    const Diagnosis d = diagnosed(arm);
    EXPECT_EQ(d.finding, Finding::kComplete) << d.text;
    EXPECT_EQ(d.effects.size(), arm.cell.effects.size()) << d.text_after;
  }
}

}  // namespace
}  // namespace plumb::offline
