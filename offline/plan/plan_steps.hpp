// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include "fit/calibration.hpp"
#include "plan/pose_plan.hpp"

namespace plumb::offline {

/// What both kinds of plan begin with.
struct PlanStart {
  ArmState state;
  std::optional<Calibration> calibration;  // none: the nominal arm
  Measurements used;                       // rows that count
  Measurements pool;                       // poses to choose from
  Measurements check;                      // others, over which predictions are judged
  double sigma_m = 0.0, sigma_rad = 0.0;
};

/// One block of rows a pose.
std::vector<Eigen::MatrixXd> blocks(const Eigen::MatrixXd& lines, int rows_each);

/// Over every pose of `check`; covariance of the space's parameters.
PredictionSigma prediction_sigma(const DesignSpace& space, const Measurements& check,
                                 const Eigen::MatrixXd& covariance);

/// The plan that tells request.separate apart.
void plan_separation(const Cell& cell, const PlanStart& start, const PlanRequest& request,
                     PosePlan& out);

/// Driving order of poses q, from the last pose measured, or from the middle of the range.
/// drive: raised by its length.
std::vector<int> driven(const Cell& cell, const PlanStart& start, const RowsN& q, double& drive);

}  // namespace plumb::offline
