// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "arm/parameter.hpp"
#include "cell/cell.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// The amplitudes of the series of waves at one joint: `count` parameters of effect `effect`, from
/// `first` on. There are hundreds of them, each with a normal prior about 0, so they are not listed
/// among the parameters of a calibration. A fit solves for both together (see FitData::series).
struct SeriesNumbers {
  int effect = 0, joint = 0;
  int first = 0, count = 0;
  Eigen::VectorXd sigma;  // of the prior, shape (count,) [rad]
};

/// One for every joint that has a series, effect by effect.
std::vector<SeriesNumbers> series_numbers(const format::Model& arm);

/// Whether it is such an amplitude.
bool is_amplitude_of_series(const format::Model& arm, const Parameter& parameter);

/// One wave of a series: its amplitude [rad] at k cycles per turn of the joint.
struct SeriesPeak {
  int joint = 0, k = 1;
  double size = 0.0;
};

/// The waves of all series, the largest first.
std::vector<SeriesPeak> series_peaks(const format::Model& arm);

/// "largest 273 µrad at 15 cycles a turn of J2, 210 at 17 and 105 at 8 of J3": the largest waves of
/// all. Where a gear ratio is known, "(1 a motor turn)" marks a wave of that many cycles per motor
/// turn. Empty without a series.
std::string series_words(const Cell& cell, const format::Model& arm);

/// sin(q), cos(q), sin(2 q), ... of every angle, shape (angles, count).
Eigen::MatrixXd series_waves(const Eigen::Ref<const Eigen::VectorXd>& q, int count);

}  // namespace plumb::offline
