// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plumb::offline {

/// What an earlier calibration says of an arm: normal, with a covariance.
struct KnownArm {
  std::vector<std::string> names;  // "J2.d"
  Eigen::VectorXd mean;            // SI, shape (names,)
  Eigen::MatrixXd covariance;      // shape (names, names)
};

}  // namespace plumb::offline
