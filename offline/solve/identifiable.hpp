// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace plumb::offline {

/// Indices of the columns whose numbers the data can tell apart, and of the other columns.
struct ColumnSubset {
  std::vector<int> kept;
  std::vector<int> dropped;
};

/// When a column counts as identifiable, given the ones before it.
struct Identifiability {
  double min_independent_share = 1e-6;  // least |part orthogonal to those kept| / |column|
  double max_std = 1e300;  // largest 1 / |orthogonal part|, the standard deviation of its number
};

/// Greedy in column order: a column stays if what is orthogonal to those kept before it is large
/// enough. J: whitened Jacobian, shape (rows, columns), rows >= 1. Householder QR, then
/// Gram-Schmidt twice on R: accurate to rounding, cost rows * columns^2.
ColumnSubset identifiable(const Eigen::MatrixXd& J, const Identifiability& limits);

}  // namespace plumb::offline
