// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

#include "arm/arm_state.hpp"

namespace plumb::offline {

/// Where a least-squares fit ended, and what it leaves there.
struct Solution {
  ArmState state;
  Eigen::VectorXd residual;  // whitened, measured - predicted, pose by pose; then the priors
  Eigen::MatrixXd jacobian;  // whitened, of the prediction, shape (residuals, parameters)
  Eigen::MatrixXd marginal;  // where series of waves were fitted as well: J^T J of the parameters,
                             // less what the series could make of them; else empty
  double series_dof = 0.0;   // numbers of the series, each by how much the poses decide it
  double cost = 0.0;         // half the sum of squares
  int iterations = 0;
  bool converged = false;
  std::string reason;  // why not, in the solver's words
};

}  // namespace plumb::offline
