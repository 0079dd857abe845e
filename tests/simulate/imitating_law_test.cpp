// SPDX-License-Identifier: Apache-2.0
// Laws that look like others, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "one_joint.hpp"
#include "simulate/simulate.hpp"
#include "simulate/study_arms.hpp"

namespace plumb::offline {
namespace {

using Eigen::Vector3d;

/// The heavy arm, seen in its own base frame, at these poses [rad], without noise.
Simulation seen(const RowsN& q, const std::string& effect) {
  Cell cell = sim::heavy_arm();
  sim::state_masses(cell, 420.0);
  cell.payload.mass_kg = 60.0;
  cell.measurement.fit_frame = cell.measurement.fit_target = false;
  SimulationPlan plan = noise_free({}, effect);
  plan.q = q;
  plan.seconds_per_pose = 60.0;
  return simulate(cell, plan);
}
Vector3d shift(const RowsN& q, const std::string& effect, int row) {
  return (seen(q, effect).true_p_M.row(row) - seen(q, "").true_p_M.row(row)).transpose();
}
RowsN rows(const std::vector<std::vector<double>>& all) {
  RowsN out(static_cast<Eigen::Index>(all.size()), 6);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < 6; ++j)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = all[i][j];
  return out;
}

TEST(EncoderCounts, GrowWithTheAngle) {
  const std::vector<double> q{-3.0, -1.2, 0.0, 0.4, 2.9};
  const auto simulation = simulate(one_joint(), noise_free(q, "encoder_counts=244urad"));
  const auto truth = first_effect(simulation)[0];
  const auto error = joint_error(simulation);
  for (std::size_t i = 0; i < q.size(); ++i)
    EXPECT_NEAR(error[i],
                244e-6 * (truth["share"].get<double>() * q[i] +
                          truth["twice_a_turn"].get<double>() *
                              std::sin(2.0 * q[i] + truth["phase_rad"].get<double>())),
                1e-13);
}

TEST(ParallelogramWave, HasItsPeriodInTheSumOfTwoAngles) {
  // Weightless: under load the wave is stronger.
  const auto turn_of = [](double q2, double q3) {
    Cell cell = one_joint();
    cell.nominal.joints.assign(3, cell.nominal.joints.front());
    for (std::size_t j = 0; j < 3; ++j) cell.nominal.joints[j].name = "J" + std::to_string(j + 1);
    cell.mechanics.assign(3, cell.mechanics.front());
    cell.gravity = {0.0, 0.0, -9.81};  // along the axes
    SimulationPlan plan = noise_free({}, "parallelogram_wave:J3=1mrad@cycles=3");
    plan.q.resize(1, 3);
    plan.q << 0.0, q2, q3;
    const Vector3d p = simulate(cell, plan).true_p_M.row(0).transpose();
    const Vector3d elbow(1.0 + std::cos(q2), std::sin(q2), 0.0);
    return std::remainder(std::atan2(p.y() - elbow.y(), p.x() - elbow.x()) - q2 - q3, 2.0 * kPi);
  };
  const double whole = 2.0 * kPi / 3.0;
  EXPECT_NEAR(turn_of(0.2, 0.1), turn_of(0.9, -0.6), 1e-12);
  EXPECT_NEAR(turn_of(0.2, 0.1), turn_of(0.2, 0.1 - whole), 1e-12);
  EXPECT_GT(std::abs(turn_of(0.2, 0.1) - turn_of(0.2, 0.4)), 1e-4);
}

TEST(RockingBase, TurnsAboutOneEdgeAndMoreToOneSide) {
  std::vector<std::vector<double>> all;
  for (int k = 0; k < 48; ++k) all.push_back({-kPi + 2.0 * kPi * k / 48, 0.6, 0.1, 0.0, 0.4, 0.0});
  const RowsN q = rows(all);
  const auto simulation = seen(q, "rocking_base=200urad");
  const auto truth = first_effect(simulation);
  const double bearing = truth["edge_bearing_rad"], stiff = truth["stiff_way_share"];
  const Vector3d edge(std::cos(bearing), std::sin(bearing), 0.0);
  const Rows3 moved = simulation.true_p_M - seen(q, "").true_p_M;
  double one_way = 0.0, other_way = 0.0;  // [m], of the height
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    EXPECT_NEAR(moved.row(i).dot(edge), 0.0, 1e-9);
    one_way = std::max(one_way, moved(i, 2)), other_way = std::max(other_way, -moved(i, 2));
  }
  EXPECT_LT(std::min(one_way, other_way), 3.0 * stiff * std::max(one_way, other_way));
  EXPECT_GT(std::max(one_way, other_way), 10e-6);
}

TEST(AxialPlay, MovesThePointAlongTheFirstAxisToEitherSide) {
  // Leaning forward and, over its back, backward.
  const RowsN q = rows({{0.3, 0.9, 0.0, 0.0, 0.3, 0.0}, {0.3, -1.2, -0.3, 0.0, 0.3, 0.0}});
  const Vector3d one = shift(q, "axial_play=50um", 0), other = shift(q, "axial_play=50um", 1);
  for (const Vector3d& each : {one, other}) {
    EXPECT_LT(each.head<2>().norm(), 1e-9);
    EXPECT_GT(std::abs(each.z()), 20e-6);
  }
  EXPECT_LT(one.z() * other.z(), 0.0);
}

TEST(MovingAir, MovesAnArmAtRestWithinMinutesAndTheSameWayAgain) {
  RowsN q(240, 6);
  for (Eigen::Index i = 0; i < q.rows(); ++i) q.row(i) << 0.2, 0.3, 0.1, 0.0, 0.4, 0.0;
  const auto first = seen(q, "moving_air=50um"), second = seen(q, "moving_air=50um");
  EXPECT_EQ(first.true_p_M, second.true_p_M);
  const Rows3 moved = first.true_p_M.rowwise() - first.true_p_M.colwise().mean();
  const double rms = std::sqrt(moved.squaredNorm() / static_cast<double>(q.rows()));
  double step = 0.0;
  for (Eigen::Index i = 1; i < q.rows(); ++i) step += (moved.row(i) - moved.row(i - 1)).norm();
  step /= static_cast<double>(q.rows() - 1);
  EXPECT_GT(rms, 1e-6);
  EXPECT_LT(step, rms) << "slowly: a minute changes it by less than it varies";
}

TEST(SunnyLink, BeginsLateAndMovesOnlyWhatIsBehindTheLink) {
  RowsN q(180, 6);
  for (Eigen::Index i = 0; i < q.rows(); ++i) q.row(i) << 0.2, 0.3, 0.1, 0.0, 0.4, 0.0;
  const auto sunny = seen(q, "sunny_link:J2=100um");
  const double begin_s = first_effect(sunny)["begin_s"];
  const Rows3 moved = sunny.true_p_M - seen(q, "").true_p_M;
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    EXPECT_EQ(moved.row(i).norm() > 0.0, 60.0 * static_cast<double>(i) > begin_s) << i;
  EXPECT_GT(moved.row(q.rows() - 1).norm(), 50e-6);
}

}  // namespace
}  // namespace plumb::offline
