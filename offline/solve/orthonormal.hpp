// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// The independent columns of J, combined so that U = J * half is orthonormal over the first
/// `fit_lines` rows.
struct Orthonormal {
  Eigen::MatrixXd U, half;  // (lines, rank), (columns of J, rank)
};
Orthonormal orthonormal(const Eigen::MatrixXd& J, Eigen::Index fit_lines);

}  // namespace plumb::offline
