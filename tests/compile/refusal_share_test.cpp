// SPDX-License-Identifier: Apache-2.0
// Where the inverse refuses, and that a correction near singular poses never makes a position worse.
#include "compile/refusal_share.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "cell/random.hpp"
#include "plumb/runtime/corrector.hpp"
#include "tests/rt/one_arm.hpp"

namespace plumb::offline {
namespace {

using Joints = Eigen::Matrix<double, 6, 1>;

/// The arm of UR10 size with errors of 1 to 3 mm, with the limit of compile() for positions.
format::Model arm(double min_singular_value) {
  format::Model out = tests::one_arm();
  out.guard.length_scale_m = 1.3;
  out.guard.max_correction_m = 0.006;
  out.guard.min_singular_value = min_singular_value;
  for (auto& row : out.nominal.joints) row.q_min = -std::numbers::pi, row.q_max = std::numbers::pi;
  out.domain.q_min.assign(6, -3.2);
  out.domain.q_max.assign(6, 3.2);
  return out;
}

JointBox whole_turns() { return JointBox(6, {-std::numbers::pi, std::numbers::pi}); }

/// The controller's own inverse, independent of the corrector's: damped least squares with
/// differences for a Jacobian, from the joints of the target. False if it does not get there.
bool controller_reaches(const Chain& nominal, const Transformd& X_BC, Joints& q) {
  const auto at = [&](const Joints& joints) {
    return nominal.forward(std::span<const double>(joints.data(), 6));
  };
  const auto error = [&](const Transformd& X) {
    Joints e;
    e << X_BC.p - X.p, rotation_vector(times_transposed<double>(X_BC.R, X.R));
    return e;
  };
  for (int k = 0; k < 100; ++k) {
    const Transformd now = at(q);
    const Joints e = error(now);
    if (e.norm() < 1e-10) return true;
    Eigen::Matrix<double, 6, 6> J;
    for (int j = 0; j < 6; ++j) {
      Joints moved = q;
      moved(j) += 1e-6;
      J.col(j) = -(error(at(moved)) - e) / 1e-6;
    }
    const double damping = 1e-3 * e.norm();
    const Eigen::Matrix<double, 6, 6> square =
        J.transpose() * J + damping * Eigen::Matrix<double, 6, 6>::Identity();
    q += square.ldlt().solve(J.transpose() * e);
  }
  return false;
}

TEST(RefusalShare, SaysHowMuchAndWhereAndLessWithTheLimitOfPositions) {
  const RefusalShare usual = refusal_share(arm(0.02), whole_turns());
  const RefusalShare near = refusal_share(arm(0.003), whole_turns());
  EXPECT_GT(usual.refused, 0.15);
  EXPECT_LT(near.refused, 0.07);
  EXPECT_LE(near.near_singular, near.refused);
  EXPECT_NE(near.where.find("most of all at J"), std::string::npos) << near.where;
  EXPECT_NE(near.where.find("deg"), std::string::npos) << near.where;
}

TEST(RefusalShare, NoPositionIsWorseThanWithoutCorrection) {
  const format::Model model = arm(0.003);
  const Corrector corrector(model);
  const ForwardModel true_arm(model);
  const Chain nominal(model.nominal);
  Random random(7);
  int corrected = 0, not_reached = 0;
  for (int i = 0; i < 3'000; ++i) {
    Joints q;
    for (int j = 0; j < 6; ++j) q(j) = std::numbers::pi * (2.0 * random.unit() - 1.0);
    const std::span<const double> seed(q.data(), 6);
    const Transformd X_BD = nominal.forward(seed);
    const Correction found = corrector.solve(X_BD, seed, SeedKind::kCommanded);
    if (refused(found.status)) continue;
    const auto miss = [&](const Joints& joints) {
      return (true_arm.predict(std::span<const double>(joints.data(), 6)).X_BT.p - X_BD.p).norm();
    };
    const double without_m = miss(q);
    Joints there = q;
    if (!controller_reaches(nominal, found.X_BC, there)) {
      ++not_reached;
      continue;
    }
    ++corrected;
    EXPECT_LT(miss(there), without_m) << q.transpose();
  }
  EXPECT_GT(corrected, 2'700);
  EXPECT_LT(not_reached, 30);
}

}  // namespace
}  // namespace plumb::offline
