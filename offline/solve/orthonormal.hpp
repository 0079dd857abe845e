// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// Independent columns of J, made orthonormal over the first `fit_lines`: U = J * half.
struct Orthonormal {
  Eigen::MatrixXd U, half;  // (lines, rank), (columns of J, rank)
};
Orthonormal orthonormal(const Eigen::MatrixXd& J, Eigen::Index fit_lines);

}  // namespace plumb::offline
