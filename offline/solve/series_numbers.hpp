// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// The numbers of the series of waves at one joint: parameters `first` to before `first + count` of
/// effect `effect`. They are no parameters of a calibration: there are hundreds of them, and each
/// is held near 0 by a normal prior. A fit solves for them together with its parameters (see
/// FitData::series).
struct SeriesNumbers {
  int effect = 0, joint = 0;
  int first = 0, count = 0;
  Eigen::VectorXd sigma;  // of the prior, shape (count,) [rad]
};

/// Of every joint that has a series, effect by effect.
std::vector<SeriesNumbers> series_numbers(const format::Model& arm);

/// One wave of a series: size [rad] at k cycles a turn of joint `joint`.
struct SeriesPeak {
  int joint = 0, k = 1;
  double size = 0.0;
};

/// The waves of all series, the largest first.
std::vector<SeriesPeak> series_peaks(const format::Model& arm);

/// "largest 273 µrad at 15 cycles a turn of J2, 210 at 17 and 105 at 8 of J3": the largest waves of
/// all; where a gear ratio is known, also "(1 a motor turn)". Empty without a series.
std::string series_words(const Cell& cell, const format::Model& arm);

/// sin(q), cos(q), sin(2 q), ... of every angle, shape (angles, count).
Eigen::MatrixXd series_waves(const Eigen::Ref<const Eigen::VectorXd>& q, int count);

}  // namespace plumb::offline
