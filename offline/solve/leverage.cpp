// SPDX-License-Identifier: Apache-2.0
#include "solve/leverage.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "numbers/cholesky.hpp"
#include "numbers/products.hpp"
#include "numbers/triangle.hpp"
#include "solve/constants.hpp"
#include "solve/jacobian_visit.hpp"

namespace plumb::offline {
namespace {

/// An orthonormal basis Q = J L^-T of the columns of J, with L L^T = J^T J. The columns are scaled
/// to unit length first.
Eigen::MatrixXd orthonormal_rows(const Eigen::MatrixXd& J) {
  const Eigen::VectorXd scale = per_norm(J);
  const Eigen::MatrixXd scaled = J * scale.asDiagonal();
  return Cholesky(gram_matrix(scaled)).orthonormal(scaled);
}

/// The lines of one pose, at most six.
using Lines = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using LinesSquare = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

/// sqrt(r^T (I - H)^-1 r) of one pose with its block H of the hat matrix. A pose that alone decides
/// a parameter has a singular I - H; the others cannot predict it, so it keeps its plain distance.
double deletion_distance(const Lines& residual, const LinesSquare& hat, double plain) {
  const LinesSquare left = LinesSquare::Identity(hat.rows(), hat.cols()) - hat;
  const Eigen::LDLT<LinesSquare> ldlt(left);
  if (ldlt.vectorD().minCoeff() <= kDecidesAlone) return plain;
  return std::sqrt(std::max(0.0, residual.dot(ldlt.solve(residual))));
}

}  // namespace

Eigen::VectorXd plain_distances(const FitData& data, const Solution& at) {
  const LineTable table = data.line_table();
  Eigen::VectorXd out(table.readings());
  for (Eigen::Index i = 0; i < out.size(); ++i)
    out(i) = at.residual.segment(table.begin(i), table.count(i)).norm();
  return out;
}

Leverage::Leverage(const FitData& data) : rows_(data.rows), table_(data.line_table()) {
  hat_.setZero(table_.most() * table_.most(), table_.readings());
}

Leverage::Leverage(const FitData& data, const Solution& at) : Leverage(data) { from_jacobian(at); }

Leverage::Leverage(const FitData& data, const Solution& at,
                   const std::vector<Parameter>& parameters)
    : Leverage(data) {
  if (!is_many(data, parameters)) {
    from_jacobian(at);
    return;
  }
  visit_jacobian(data, at.state, parameters, [&](int first, const RowMajorMatrix& J) {
    const Eigen::MatrixXd Q = upper_transposed_solved(at.jacobian, J.transpose());
    for (Eigen::Index i = first, line = 0; line < J.rows(); line += table_.count(i++))
      put(i, Q.middleCols(line, table_.count(i)).transpose());
  });
}

void Leverage::from_jacobian(const Solution& at) {
  if (at.jacobian.cols() == 0) return;
  const Eigen::MatrixXd Q = orthonormal_rows(at.jacobian);
  for (Eigen::Index i = 0; i < hat_.cols(); ++i)
    put(i, Q.middleRows(table_.begin(i), table_.count(i)));
}

template <class Lines>
void Leverage::put(Eigen::Index pose, const Lines& orthonormal) {
  const LinesSquare hat = orthonormal * orthonormal.transpose();
  hat_.col(pose).head(hat.size()) = hat.reshaped();
}

Eigen::VectorXd Leverage::distances(const FitData& data, const Solution& now) const {
  Eigen::VectorXd out = plain_distances(data, now);
  const bool same = data.rows == rows_;
  const LineTable table = data.line_table();
  std::size_t known = 0;
  for (std::size_t i = 0; i < data.rows.size(); ++i) {
    const int row = data.rows[i];
    if (same) known = i;
    while (known < rows_.size() && rows_[known] < row && !same) ++known;
    if (known == rows_.size()) break;
    if (rows_[known] != row) continue;
    const auto at = static_cast<Eigen::Index>(i);
    const auto own = static_cast<Eigen::Index>(known), lines = table_.count(own);
    const LinesSquare hat = hat_.col(own).head(lines * lines).reshaped(lines, lines);
    out(at) = deletion_distance(now.residual.segment(table.begin(at), lines), hat, out(at));
  }
  return out;
}

}  // namespace plumb::offline
