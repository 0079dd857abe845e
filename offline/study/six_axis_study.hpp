// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cell/cell.hpp"

namespace plumb::offline::study {

/// The study's last experiment, repeated where the truth is known: 45 poses of a six-axis arm,
/// three trees of five leaves, and an error quoted on the poses they were trained with.
struct SixAxisRequest {
  int draws = 20;  // arms, poses and noise anew each time
  int poses = 45;
  std::uint64_t seed = 1;
  std::function<void(const std::string&)> tell = [](const std::string&) {};
};

/// One arm. Mean errors [m]; true ones are against the noise-free point on 2000 fresh poses.
struct SixAxisDraw {
  double before = 0.0;          // at the 45 poses, nominal arm, frame and target fitted
  double published_seen = 0.0;  // the same with the trees, at the same poses: what the paper quotes
  double before_fresh = 0.0;    // true, without correction
  double published_fresh = 0.0;  // true, with the trees
  double ours_fresh = 0.0;       // true, with what the diagnosis added
  double noise_seen = 0.0;       // five-leaf trees on white noise of the same size, same poses
  double noise_fresh = 0.0;      // what those trees do where there is nothing to correct
  std::string added;             // by the diagnosis
  std::string tree;              // why there is no tree
};

struct SixAxisStudy {
  SixAxisRequest request;
  std::vector<SixAxisDraw> draws;
};

/// Table 2 of the paper, an assumed sixth axis and tool, assumed masses.
Cell six_axis_cell();

SixAxisStudy run_six_axis_study(const SixAxisRequest& request);

/// Median over the draws of one figure.
double median_of(const SixAxisStudy& study, double SixAxisDraw::*figure);
double worst_of(const SixAxisStudy& study, double SixAxisDraw::*figure);

}  // namespace plumb::offline::study
