// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include "arm/arm_state.hpp"
#include "arm/predicted_points.hpp"
#include "figures/run_results.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline::figures {

/// A run that nobody fitted: a perfectly known random arm at random poses, with chosen errors.
/// Every fifth pose is held out unless `held` says none is.
struct MadeRun {
  enum class Held { kEveryFifth, kNone };

  Cell cell;
  Measurements measured;
  mutable Run run;  // its predictions follow the errors below
  tests::Random random;
  Rows3 before_M, after_M;

  MadeRun(int poses, int joints, Held held = Held::kEveryFifth) : cell(arm_of(joints)), random(11) {
    cell.tolerance_m = 0.1e-3;
    ArmState& state = run.fit.calibration.state;
    state.arm.calibrated = cell.nominal;
    state.X_MB = {{2.0, -1.0, 0.5}, {0.8, 0.0, 0.0, 0.6}};
    state.X_TG.p = {0.05, 0.02, 0.1};
    measured.q.resize(poses, joints);
    for (int i = 0; i < poses; ++i) {
      for (int j = 0; j < joints; ++j) {
        const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
        measured.q(i, j) = random.uniform(row.q_min, row.q_max);
      }
      measured.pose.push_back("P" + std::to_string(i + 1));
      measured.replicate_group.push_back(i);
      measured.set.push_back(SetMark::kUnmarked);
      run.fit.split.fold.push_back(-1);
      run.fit.split.used.push_back(true);
      run.fit.split.held.push_back(held == Held::kEveryFifth && i % 5 == 0);
    }
    measured.p_M = predict_points(state, measured);
    run.number = 3;
    run.fit.floor = {.sigma_m = 10e-6, .mean_m = 16e-6, .rms_m = 17e-6, .dof = 20};
    before_M = noise(1e-3);
    after_M = noise(20e-6);
  }

  /// An arm of six joints that was cut off, or goes on with copies of its last ones.
  static Cell arm_of(int joints) {
    Cell out = random_cell(7, 6, format::Convention::kModified, ArmKind::kRevolute);
    while (out.joints() > joints) out.nominal.joints.pop_back();
    while (out.joints() < joints) {
      out.nominal.joints.push_back(out.nominal.joints[out.nominal.joints.size() - 2]);
      out.nominal.joints.back().name = "J" + std::to_string(out.joints());
    }
    out.mechanics.resize(out.nominal.joints.size());
    return out;
  }

  Rows3 noise(double sigma_m) {
    Rows3 out(measured.size(), 3);
    for (Eigen::Index i = 0; i < out.size(); ++i)
      out.data()[i] = sigma_m * std::sqrt(-2.0 * std::log(1.0 - random.uniform(0.0, 1.0))) *
                      std::cos(2.0 * M_PI * random.uniform(0.0, 1.0));
    return out;
  }

  RunResults results() const {
    run.fit.predicted_M = measured.p_M - after_M;
    RunResults out{.cell = cell,
                   .measured = measured,
                   .run = run,
                   .before_M = before_M,
                   .after_M = after_M,
                   .held = {},
                   .fit = {}};
    for (int i = 0; i < measured.size(); ++i)
      (run.fit.split.held[static_cast<std::size_t>(i)] ? out.held : out.fit).push_back(i);
    return out;
  }
};

}  // namespace plumb::offline::figures
