// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "diagnose/regressor_score.hpp"
#include "fit/calibrate.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {

/// A healthy arm of six joints at 100 poses, every fifth of which is held out.
struct WhitenedArm {
  WhitenedArm() {
    BlindRequest request;
    request.poses = 100;
    request.fresh_poses = 1;
    request.repeats = 1;
    request.seed = 5;
    blind = make_blind_case(request);
    std::vector<int> fit, held;
    for (int i = 0; i < blind.measured.measured.size(); ++i) (i % 5 == 0 ? held : fit).push_back(i);
    calibration = calibrate(blind.cell, blind.measured.measured, fit);
    whitened = make_whitened_fit(blind.cell, blind.measured.measured, calibration,
                                 without_outliers(fit, calibration.outliers), held);
    whitened.noise = {1.0, 40.0, true};
  }
  WhitenedArm(const WhitenedArm&) = delete;

  BlindCase blind;
  Calibration calibration;
  WhitenedFit whitened;
};

/// Made once a program.
inline const WhitenedArm& whitened_arm() {
  static const WhitenedArm arm;
  return arm;
}

inline EffectEntry entry_of(const std::string& name, std::vector<int> joints = {}) {
  return {.name = name, .joints = std::move(joints), .options = {}, .place = {}};
}

/// The fit with these lines as its residual.
inline WhitenedFit leaving(WhitenedFit whitened, const Eigen::VectorXd& lines) {
  whitened.y = lines;
  clear_residual(whitened);
  fold_joints(whitened);
  return whitened;
}

/// The noise that the fit says it has: of variance 1 in every line.
inline Eigen::VectorXd noise_of(const WhitenedFit& whitened, std::uint64_t seed) {
  tests::Random random(seed);
  Eigen::VectorXd out(whitened.y.size());
  for (double& line : out) {
    line = -6.0;
    for (int i = 0; i < 12; ++i) line += random.uniform(0.0, 1.0);
  }
  return out;
}

/// A motion of the point by these columns, alike for each, so large that its root mean square is
/// `size` times the noise.
inline Eigen::VectorXd motion_of_size(const WhitenedFit& whitened, const Regressor& regressor,
                                      double size) {
  const Eigen::VectorXd one =
      motion(whitened, regressor, Eigen::VectorXd::Ones(regressor.columns.cols()));
  return one * (size * std::sqrt(static_cast<double>(one.size())) / one.norm());
}

}  // namespace plumb::offline
