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
  int draws = 20;  // each with a new arm, new poses and new noise
  int poses = 45;
  std::uint64_t seed = 1;
  std::function<void(const std::string&)> tell = [](const std::string&) {};
};

/// The result for one arm. Mean errors [m]. True errors are relative to points without noise, at
/// 2000 fresh poses.
struct SixAxisDraw {
  double before = 0.0;           // at the 45 poses; nominal arm, frame and target fitted
  double published_seen = 0.0;   // with the trees at the same poses, as in the paper
  double before_fresh = 0.0;     // true error without correction
  double published_fresh = 0.0;  // true error with the trees
  double ours_fresh = 0.0;       // true error with the diagnosed effects
  double noise_seen = 0.0;       // trees fitted to white noise of the same size
  double noise_fresh = 0.0;      // the same trees where there is nothing to correct
  std::string added;             // effects that the diagnosis added
  std::string tree;              // the reason why there is no tree
};

struct SixAxisStudy {
  SixAxisRequest request;
  std::vector<SixAxisDraw> draws;
};

/// The arm of table 2 of the paper with an assumed sixth axis, tool and masses.
Cell six_axis_cell();

SixAxisStudy run_six_axis_study(const SixAxisRequest& request);

/// The median of one figure over all draws.
double median_of(const SixAxisStudy& study, double SixAxisDraw::*figure);
double worst_of(const SixAxisStudy& study, double SixAxisDraw::*figure);

}  // namespace plumb::offline::study
