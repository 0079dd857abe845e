// SPDX-License-Identifier: Apache-2.0
#include "simulate/imperfections.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "one_joint.hpp"
#include "simulate/random.hpp"
#include "simulate/statics.hpp"
#include "simulate/study_arms.hpp"
#include "tests/cases/blind_case.hpp"

namespace plumb::offline {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

std::vector<double> turns(int count) {
  std::vector<double> q;
  for (int k = 0; k < count; ++k) q.push_back(-3.0 + 6.0 * k / count);
  return q;
}

TEST(JointScatter, IsSharedInPlaceAndDrawnAnewWhenAPoseIsVisitedAgain) {
  SimulationPlan plan = noise_free(turns(100), "");
  plan.repeats = 3;
  plan.revisits = 100;
  plan.imperfections.joint_scatter = {30e-6};
  const auto error = joint_error(simulate(one_joint(), plan));
  ASSERT_EQ(error.size(), 220U);  // every tenth pose three times, and each once more
  EXPECT_NEAR(error[0], error[1], 1e-15) << "in place";
  EXPECT_NEAR(error[0], error[2], 1e-15) << "in place";
  EXPECT_GT(std::abs(error[0] - error[120]), 1e-7) << "at another stop";
  double square = 0.0;
  for (const double e : error) square += e * e / static_cast<double>(error.size());
  // 200 stops: the variance is good to 10 % (1 sigma).
  EXPECT_NEAR(std::sqrt(square) / 30e-6, 1.0, 0.2);
}

TEST(JointScatter, IsThatOfEachJoint) {
  SimulationPlan plan;
  plan.poses = 400;
  plan.noise_m = 0.0;
  const Cell cell = sim::heavy_arm();
  const auto still = simulate(cell, plan);
  plan.imperfections.joint_scatter = {0, 0, 0, 0, 0, 40e-6};
  const auto scattered = simulate(cell, plan);
  EXPECT_EQ(still.measured.q, scattered.measured.q);
  // Only the last joint scatters, so a reflector moves by no more than its distance from that axis.
  const double away = std::hypot(still.X_TG.p[0], still.X_TG.p[1]);
  const Rows3 moved = scattered.measured.p_M - still.measured.p_M;
  const double rms = std::sqrt(moved.squaredNorm() / 400.0);
  EXPECT_NEAR(rms / (40e-6 * away), 1.0, 0.15);
}

TEST(RoundedEncoders, ChangeTheRecordAndNotTheArm) {
  SimulationPlan plan = noise_free(turns(50), "");
  const auto exact = simulate(one_joint(), plan);
  plan.imperfections.encoder_step = 1e-3;
  const auto rounded = simulate(one_joint(), plan);
  EXPECT_EQ(exact.measured.p_M, rounded.measured.p_M);
  for (int row = 0; row < 50; ++row) {
    const double steps = rounded.measured.q(row, 0) / 1e-3;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
    EXPECT_LE(std::abs(rounded.measured.q(row, 0) - exact.measured.q(row, 0)), 0.5e-3 + 1e-12);
  }
}

TEST(TrueGravity, BendsTheArmWhereTheCellSaysOtherwise) {
  Cell cell = one_joint();  // gravity along -y
  cell.mechanics[0].link_mass_kg = 10.0;
  cell.mechanics[0].link_com_m = {0.5, 0.0, 0.0};
  SimulationPlan plan = noise_free({0.0, kPi / 2.0}, "joint_compliance:J1=100urad");
  plan.truth.richness = 0.0;
  const auto upright = joint_error(simulate(cell, plan));
  EXPECT_GT(std::abs(upright[0]), 90e-6);
  EXPECT_LT(std::abs(upright[1]), 1e-9) << "hanging along the stated gravity";
  plan.imperfections.gravity = {-9.81, 0.0, 0.0};
  const auto wall = joint_error(simulate(cell, plan));
  EXPECT_LT(std::abs(wall[0]), 1e-9);
  EXPECT_GT(std::abs(wall[1]), 90e-6);
}

TEST(CoupledDrives, AreUndoneByTheirReverse) {
  const sim::Drives drives({2, 3});
  const VectorXd q = VectorXd::LinSpaced(5, 0.1, 0.9);
  EXPECT_LT((drives.to_joints(drives.of_joints(q)) - q).norm(), 1e-15);
  EXPECT_NEAR(drives.of_joints(q)(2), q(1) + q(2), 1e-15);
  EXPECT_NEAR(drives.of_joints(q)(3), q(1) + q(2) + q(3), 1e-15);
}

// The torque of a drive is the slope of the potential energy over its position, all other drives
// at rest.
TEST(CoupledDrives, TheirTorquesAreThoseOfVirtualWork) {
  Cell cell = sim::palletiser_arm();
  sim::state_masses(cell, 300.0);
  const sim::Arm arm(cell.nominal);
  auto masses = sim::guess_masses(cell, arm, 0.0, sim::Random(1, "masses"));
  masses.drives = sim::Drives({2, 3});
  masses.payload = 40.0;
  const auto energy = [&](const VectorXd& driven) {
    const auto frames = arm.frames(masses.drives.to_joints(driven));
    double out = -masses.payload * masses.gravity.dot(frames.flange * masses.payload_com);
    for (std::size_t i = 0; i < masses.mass.size(); ++i)
      out -= masses.mass[i] * masses.gravity.dot(frames.joint[i] * masses.com[i]);
    return out;
  };
  VectorXd q(5);
  q << 0.3, 0.4, -0.2, -0.2, 1.0;
  const VectorXd driven = masses.drives.of_joints(q);
  const sim::Loads loads(masses, arm.frames(q));
  for (int j = 0; j < 5; ++j) {
    const double step = 1e-5;
    VectorXd more = driven, less = driven;
    more(j) += step, less(j) -= step;
    EXPECT_NEAR(loads.torque(j), -(energy(more) - energy(less)) / (2.0 * step), 1e-4) << j;
  }
}

// A parallelogram keeps what it carries level, whatever error its crank has.
TEST(CoupledDrives, AnErrorOfTheSecondDriveDoesNotTurnTheThirdLink) {
  SimulationPlan plan;
  plan.poses = 30;
  plan.noise_m = 0.0;
  plan.noise_rad = 0.0;
  const auto turned = [&](const std::vector<int>& coupled) {
    plan.imperfections.coupled = coupled;
    plan.truth.effects.clear();
    const auto straight = simulate(sim::heavy_arm(), plan);
    plan.truth.effects = {"gear_harmonics:J2=500urad"};
    const auto bent = simulate(sim::heavy_arm(), plan);
    EXPECT_GT((bent.measured.p_M - straight.measured.p_M).norm(), 1e-4);
    return (bent.measured.quat_M - straight.measured.quat_M).norm();
  };
  EXPECT_GT(turned({}), 1e-4);
  EXPECT_LT(turned({2}), 1e-12);
}

TEST(OvercompensatedReversal, IsTheNegativeOfAReversal) {
  const std::vector<double> q{0.5, -0.5, 0.7, 0.2, 0.9, -1.0};
  const auto short_of = joint_error(simulate(one_joint(), noise_free(q, "reversal:J1=100urad")));
  const auto too_far =
      joint_error(simulate(one_joint(), noise_free(q, "overcompensated_reversal:J1=100urad")));
  for (std::size_t row = 0; row < q.size(); ++row) {
    EXPECT_GT(std::abs(short_of[row]), 50e-6);
    EXPECT_NEAR(short_of[row], -too_far[row], 1e-12);
  }
}

TEST(TwoSteps, MoveTheSetUpAtTwoPosesAndNowhereElse) {
  SimulationPlan plan;
  plan.poses = 200;
  plan.noise_m = 0.0;
  const Cell cell = sim::heavy_arm();
  for (const char* law : {"two_steps_base", "two_steps_reflector"}) {
    plan.truth.effects.clear();
    const auto still = simulate(cell, plan);
    plan.truth.effects = {std::string(law) + "=1mm"};
    const auto moved = simulate(cell, plan);
    const auto moves = first_effect(moved)["moves"];
    ASSERT_EQ(moves.size(), 2U);
    const int first = moves[0]["row_after"], second = moves[1]["row_after"];
    EXPECT_LT(first, second);
    EXPECT_EQ(moves[0]["pose_after"], moved.measured.pose[static_cast<std::size_t>(first)]);
    for (int row = 0; row < 200; ++row) {
      const double away = (moved.measured.p_M.row(row) - still.measured.p_M.row(row)).norm();
      if (row < first) {
        EXPECT_EQ(away, 0.0);
      } else {
        EXPECT_GT(away, 1e-5) << row;
      }
    }
    const auto shift = [&](int row) {
      return (moved.measured.p_M.row(row) - still.measured.p_M.row(row)).norm();
    };
    EXPECT_GT(std::abs(shift(second) - shift(second - 1)), 1e-5);
  }
}

TEST(Revisits, BelongToTheirPose) {
  BlindRequest request;
  request.poses = 60;
  request.revisits = 12;
  request.held_share = 0.3;
  request.fresh_poses = 10;
  const auto made = make_blind_case(request);
  const auto& m = made.measured.measured;
  ASSERT_EQ(m.size(), 60 + 6 * 2 + 12);
  const auto* payload = m.tables.at(0).find("payload");
  for (int row = 72; row < m.size(); ++row) {
    const int pose = m.replicate_group[row];
    EXPECT_EQ(pose, (row - 72) * 5);
    int first = 0;
    while (m.replicate_group[first] != pose) ++first;
    EXPECT_EQ(m.pose[row], m.pose[first]);
    EXPECT_EQ(m.set[row], m.set[first]);
    EXPECT_EQ(m.q.row(row), m.q.row(first));
    EXPECT_EQ(payload->values[row], payload->values[first]);
  }
  EXPECT_EQ(made.fresh.measured.size(), 10);
}

// The reader of cell files is the one that says in which frame a centre of mass is meant.
TEST(StatedMasses, InTheOtherFrameAreRightWhereTheCellSaysSo) {
  for (const auto arm : {BlindArm::kHeavy, BlindArm::kLight, BlindArm::kTrack}) {
    BlindRequest request;
    request.arm = arm;
    request.poses = request.fresh_poses = 10;
    request.masses = StatedMasses::kRight;
    const Cell right = parse_cell(make_blind_case(request).cell_toml, "/nowhere/cell.toml");
    request.masses = StatedMasses::kOtherFrame;
    const std::string text = make_blind_case(request).cell_toml;
    const Cell wrong = parse_cell(text, "/nowhere/cell.toml");
    const Cell mended = parse_cell(
        std::regex_replace(text, std::regex("\ncom_mm = "), "\ncom_frame = \"dh\"\ncom_mm = "),
        "/nowhere/cell.toml");
    double off = 0.0;
    for (int j = 0; j < right.joints(); ++j) {
      const auto com = [j](const Cell& cell) {
        return Vector3d(cell.mechanics[j].link_com_m->data());
      };
      EXPECT_LT((com(right) - com(mended)).norm(), 1e-9) << j;
      off = std::max(off, (com(right) - com(wrong)).norm());
    }
    EXPECT_GT(off, 0.1);
    request.masses = StatedMasses::kNone;
    const Cell none = parse_cell(make_blind_case(request).cell_toml, "/nowhere/cell.toml");
    EXPECT_FALSE(none.mechanics[1].link_mass_kg.has_value());
  }
}

TEST(Imperfections, NewPosesOfTheArmHaveThemOnlyWhereTheyAreAskedFor) {
  BlindRequest request;
  request.fresh_poses = 50;
  EXPECT_FALSE(make_blind_case(request).fresh_scattered.has_value());
  request.imperfections.joint_scatter = {20e-6};
  request.imperfections.encoder_step = 100e-6;
  const auto made = make_blind_case(request);
  ASSERT_TRUE(made.fresh_scattered.has_value());
  const auto& perfect = made.fresh_robot.measured;
  const auto& scattered = made.fresh_scattered->measured;
  EXPECT_GT((perfect.p_M - scattered.p_M).norm(), 1e-5);
  EXPECT_LE((perfect.q - scattered.q).cwiseAbs().maxCoeff(), 50e-6 + 1e-12);
  EXPECT_GT((perfect.q - scattered.q).cwiseAbs().maxCoeff(), 10e-6);
}

TEST(BlindArms, OfAPalletiserTheFlangeIsLevel) {
  BlindRequest request;
  request.arm = BlindArm::kPalletiser;
  request.poses = 40;
  request.fresh_poses = 10;
  const auto made = make_blind_case(request);
  const auto& q = made.measured.measured.q;
  EXPECT_EQ(q.rows(), 40 + 4 * 2);
  EXPECT_LT((q.col(1) + q.col(2) + q.col(3)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(made.fresh_robot.measured.q.rows(), 10);
  const auto truth = nlohmann::json::parse(made.truth_json);
  EXPECT_EQ(truth["imperfections"]["coupled_drives"], (nlohmann::json{"J3", "J4"}));
}

}  // namespace
}  // namespace plumb::offline
