// SPDX-License-Identifier: Apache-2.0
#include "solve/identifiable.hpp"

#include "numbers/triangle.hpp"

namespace plumb::offline {

ColumnSubset identifiable(const Eigen::MatrixXd& J, const Identifiability& limits) {
  const Eigen::Index columns = J.cols();
  const Eigen::Index rows = std::min(J.rows(), columns);
  const Eigen::MatrixXd R = householder_triangle(J);
  Eigen::MatrixXd basis(rows, rows);
  Eigen::Index rank = 0;
  ColumnSubset out;
  for (Eigen::Index k = 0; k < columns; ++k) {
    const double whole = R.col(k).norm();
    Eigen::VectorXd rest = R.col(k);
    for (int pass = 0; pass < 2; ++pass)
      rest -= basis.leftCols(rank) * (basis.leftCols(rank).transpose() * rest);
    const double part = rest.norm();
    const bool independent =
        rank < rows && part > limits.min_independent_share * whole && part * limits.max_std > 1.0;
    if (independent) basis.col(rank++) = rest / part;
    (independent ? out.kept : out.dropped).push_back(static_cast<int>(k));
  }
  return out;
}

}  // namespace plumb::offline
