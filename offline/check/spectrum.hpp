// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// Singular values of a Jacobian whose columns are scaled to unit length, so that units do not
/// matter; columns of zeros stay zero.
struct Spectrum {
  Eigen::VectorXd values;  // descending
  int rank = 0;            // values above 1e-7 of the largest
  double condition = 0.0;  // largest over the smallest above that
};

/// Cost: rows * columns^2.
Spectrum spectrum(const Eigen::MatrixXd& J);

/// Singular values of J without scaling, descending.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& J);

}  // namespace plumb::offline
