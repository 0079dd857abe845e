// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "fit/arm_state.hpp"
#include "fit/known_arm.hpp"
#include "fit/parameter.hpp"

namespace plumb::offline {

/// Combinations of the arm's numbers about which the poses say next to nothing: each row of
/// `weights` times what the numbers are away from nominal is a distance in standard deviations.
struct WeakDirections {
  std::vector<Parameter> parameters;
  Eigen::MatrixXd weights;  // shape (directions, parameters) [1/SI]
  Eigen::VectorXd share;    // of each number that lies in these directions, 0 to 1
};

/// What a geometric fit is weighed with: rows used, and 1 sigma of each coordinate.
struct FitData {
  const Measurements* measured = nullptr;
  std::vector<int> rows;
  Rows3 sigma_m;               // shape (all poses, 3)
  double sigma_rad = 0.0;      // 0: orientation is not used
  const Cell* cell = nullptr;  // with its priors, or null: none
  WeakDirections weak = {};    // held near nominal; the parameters of a fit must contain theirs
  KnownArm arm = {};           // what an earlier calibration says of the numbers fitted
  bool series = false;         // solves for the numbers of series of waves as well

  int per_pose() const;        // residuals of one pose
  int residual_count() const;  // of all poses, priors not counted
};

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

/// Least squares over `parameters` from `start` with Ceres (Levenberg-Marquardt, exact
/// derivatives), until an iteration gains less than `tolerance` of the cost, or until many of them
/// together move the predicted points by less than a small share of the noise: parameters that the
/// points do not show may then still be on their way. With `parameters` empty it only evaluates.
Solution solve(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters,
               double tolerance = 1e-12);

/// Whitened residuals and derivatives at `start`, without solving.
Solution evaluate(const FitData& data, const ArmState& start,
                  const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
