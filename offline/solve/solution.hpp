// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

#include "arm/arm_state.hpp"

namespace plumb::offline {

/// Where a least-squares fit ended, with its residuals and derivatives there.
struct Solution {
  ArmState state;
  Eigen::VectorXd residual;  // whitened measured - predicted, pose by pose; then the priors
  Eigen::MatrixXd jacobian;  // whitened, of the prediction, shape (residuals, parameters)
  Eigen::MatrixXd marginal;  // if series of waves were fitted as well: information on the
                             // parameters with the series unknown; else empty
  double series_dof = 0.0;   // effective number of amplitudes of the series: each counts as the
                             // share of it that the poses decide rather than its prior
  double cost = 0.0;         // half the sum of squares
  int iterations = 0;
  bool converged = false;
  std::string reason;  // why it did not converge, in the solver's words
};

}  // namespace plumb::offline
