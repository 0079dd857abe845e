// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "figures/run_results.hpp"
#include "plan/pose_plan.hpp"

namespace plumb::offline::figures {

/// What each of the next poses would tell, in the order of their worth.
struct PoseGain {
  std::string pose;      // as the plan names it
  double nats = 0.0;     // by how much it raises ln det of the information, given those before
  double sigma_m = 0.0;  // mean 1 sigma of the predicted point after it
};

/// How information about a cell grows with the poses of a plan, and with as many at random.
struct InformationGrowth {
  double sigma_now_m = 0.0;
  std::vector<PoseGain> planned, random;
  int numbers = 0;               // parameters
  int measured = 0;              // poses that count already
  std::vector<Problem> remarks;  // of the plan
};

/// For the next n poses, at the arm of the run. Cost: that of `plan_poses` with a pool of 800.
/// Throws Failure as `plan_poses`.
InformationGrowth information_growth(const RunResults& results, int n);

/// One SVG file, `width` px wide (320 to 4000).
std::string observability_figure(const InformationGrowth& growth, int run, double width);

}  // namespace plumb::offline::figures
