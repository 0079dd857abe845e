// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "figures/run_results.hpp"

/// Figures of what a run has learnt and of what its measurements say over time. Each returns one
/// SVG file, `width` px wide (320 to 4000), whatever the data.
namespace plumb::offline::figures {

/// The residual along each measured axis in the order of measuring, with a moving mean and the
/// moments at which something moved. Cost: that of `change_points`.
std::string order_figure(const RunResults& results, double width);

/// Fitted less nominal value of every number of the arm with its 95 % interval, beside the range in
/// which arms usually are; numbers of effects in standard deviations.
std::string parameters_figure(const RunResults& results, double width);

/// A model on the way to the run: what was added, and what that did to the held-out poses.
struct WaterfallStep {
  std::string added;    // in plain names: "geometry", "joint compliance and drift"
  double mean_m = 0.0;  // held-out error
  int worse = 0;        // held-out poses whose error grew beyond noise, against the step before
};

/// The steps from the nominal arm to the run. In between are those of the `earlier` runs that have
/// the same held-out poses, each with fewer effects than the next.
std::vector<WaterfallStep> waterfall_steps(const RunResults& results,
                                           const std::vector<Run>& earlier);

/// The mean held-out error of these steps as bars, with noise floor and tolerance.
std::string waterfall(const RunResults& results, const std::vector<WaterfallStep>& steps,
                      double width);

/// The mean error of the run's rechecks one after the other, before and after what had changed was
/// refitted, with the control limit: three standard deviations above the expected mean, which a
/// check exceeds by chance about once in a thousand times.
std::string history_figure(const RunResults& results, double width);

/// The error at readings that were not fitted over the number of poses that were, of the arm alone
/// and with what an earlier run or other arms taught. Cost: that of `error_by_poses`.
std::string poses_figure(const RunResults& results, double width);

}  // namespace plumb::offline::figures
