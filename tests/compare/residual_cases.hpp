// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>

#include "arm/arm_state.hpp"
#include "arm/predicted_points.hpp"
#include "cell/measurements.hpp"
#include "noise/series.hpp"
#include "noise/step_motions.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline::compare {

inline double normal(tests::Random& random) {
  return std::sqrt(-2.0 * std::log(1.0 - random.uniform(0.0, 1.0))) *
         std::cos(2.0 * M_PI * random.uniform(0.0, 1.0));
}

/// A random six-axis arm at random poses, perfectly known: what is added to the residuals is all
/// there is.
struct ResidualCase {
  Cell cell;
  ArmState state;
  Measurements measured;
  Rows3 error;
  tests::Random random;

  ResidualCase(std::uint64_t seed, int poses)
      : cell(random_cell(seed, 6, format::Convention::kModified, ArmKind::kRevolute)),
        random(seed * 7919 + 1) {
    state.arm.calibrated = cell.nominal;
    state.X_MB = {{2.0, -1.0, 0.5}, {0.8, 0.0, 0.0, 0.6}};
    state.X_TG.p = {0.05, 0.02, 0.1};
    measured.q.resize(poses, 6);
    for (int i = 0; i < poses; ++i) {
      for (int j = 0; j < 6; ++j)
        measured.q(i, j) =
            random.uniform(cell.nominal.joints[j].q_min, cell.nominal.joints[j].q_max);
      measured.pose.push_back("P" + std::to_string(i + 1));
      measured.replicate_group.push_back(i);
      measured.set.push_back(SetMark::kUnmarked);
    }
    measured.p_M = predict_points(state, measured);
    error = Rows3::Zero(poses, 3);
  }

  int size() const { return measured.size(); }

  void add_noise(double sigma) {
    for (Eigen::Index i = 0; i < error.rows(); ++i)
      for (int k = 0; k < 3; ++k) error(i, k) += sigma * normal(random);
  }

  /// What the arm measures in another state, with these weights by row.
  void add_change(const ArmState& other, const std::function<double(int)>& weight) {
    const Rows3 moved = predict_points(other, measured.q) - predict_points(state, measured.q);
    for (int i = 0; i < size(); ++i) error.row(i) += weight(i) * moved.row(i);
  }

  Series in_order() const {
    std::vector<int> rows;
    for (int i = 0; i < size(); ++i) rows.push_back(i);
    return series(measured, error, rows);
  }
  StepMotions motions() const { return {state, measured, in_order()}; }
};

/// The state with something moved, so that the point moves by about `size_m`.
inline ArmState moved_state(ResidualCase& at, MotionSource source, int joint, double size_m) {
  ArmState out = at.state;
  const auto random_axis = [&] {
    Eigen::Vector3d v(normal(at.random), normal(at.random), normal(at.random));
    return Eigen::Vector3d(v.normalized() * size_m);
  };
  const Eigen::Vector3d shift = random_axis();
  if (source == MotionSource::kTool)
    for (int k = 0; k < 3; ++k) out.X_TG.p[k] += shift(k);
  if (source == MotionSource::kBase)
    for (int k = 0; k < 3; ++k) out.X_MB.p[k] += shift(k);
  if (source == MotionSource::kJoint)
    out.arm.calibrated.joints[joint].theta += size_m;  // 1 m of lever
  return out;
}

}  // namespace plumb::offline::compare
