// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace plumb::offline {

/// Columns that data can tell apart, and those that they cannot.
struct Subset {
  std::vector<int> kept;
  std::vector<int> dropped;
};

/// When a column counts as identifiable, given the ones before it.
struct Identifiability {
  double min_independent_share = 1e-6;  // |part orthogonal to those kept| / |column|
  double max_std = 1e300;               // 1 / |orthogonal part|: standard deviation of its number
};

/// Greedy in column order: a column stays if what is orthogonal to those kept before it is large
/// enough. J: whitened Jacobian, shape (rows, columns), rows >= 1. Householder QR, then
/// Gram-Schmidt twice on R: accurate to rounding, cost rows * columns^2.
Subset identifiable(const Eigen::MatrixXd& J, const Identifiability& limits);

}  // namespace plumb::offline
