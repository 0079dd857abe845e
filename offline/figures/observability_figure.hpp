// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "figures/run_results.hpp"

namespace plumb::offline::figures {

/// What one of the next poses would tell.
struct PoseGain {
  std::string pose;      // which of the random ones
  double nats = 0.0;     // by how much it raises ln det of the information, given those before
  double sigma_m = 0.0;  // mean 1 sigma of the predicted point after it
};

/// How information about a cell grows with well chosen poses, the most telling first, and with as
/// many at random.
struct InformationGrowth {
  double sigma_now_m = 0.0;
  std::vector<PoseGain> planned = {}, random = {};
  int numbers = 0;   // parameters
  int measured = 0;  // poses that count already
};

/// The growth by the next n poses, linearised at the arm of the run. Each planned pose is the one
/// of 800 random poses that tells most after those before it. Cost: derivatives at the measured
/// poses and 1000 more, and poses * parameters^2. Throws Failure as `pose_pool`.
InformationGrowth information_growth(const RunResults& results, int n);

/// One SVG file, `width` px wide (320 to 4000).
std::string observability_figure(const InformationGrowth& growth, int run, double width);

}  // namespace plumb::offline::figures
