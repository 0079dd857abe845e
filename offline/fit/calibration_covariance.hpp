// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// (J^T J)^-1, computed by QR of the Jacobian with columns of unit length.
Eigen::MatrixXd inverse_information(const Eigen::MatrixXd& J);

/// cond_2(J^T J) of the robot parameters, in SI. information: J^T J of all parameters.
double calibrability(const Eigen::MatrixXd& information, const std::vector<Parameter>& parameters);

/// Covariance of all parameters. That of the numbers in `arm` is given. The others are estimated
/// from the readings for each value of these, so that their covariance follows by propagation.
/// J: whitened derivatives of the readings by `parameters`.
Eigen::MatrixXd covariance_with(const KnownArm& arm, const Eigen::MatrixXd& J,
                                const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
