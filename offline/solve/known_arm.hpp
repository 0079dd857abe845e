// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plumb::offline {

/// A normal prior of numbers of the arm, as an earlier calibration gives it.
struct KnownArm {
  std::vector<std::string> names;  // "J2.d"
  Eigen::VectorXd mean;            // SI, shape (names,)
  Eigen::MatrixXd covariance;      // shape (names, names)
};

}  // namespace plumb::offline
