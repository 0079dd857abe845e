// SPDX-License-Identifier: Apache-2.0
#include "solve/orthonormal.hpp"

#include <algorithm>

#include "numbers/pivoted_qr.hpp"
#include "numbers/triangle.hpp"

namespace plumb::offline {
namespace {

constexpr double kIndependent = 1e-9;    // rank: diagonal of R over its largest one
constexpr Eigen::Index kQrLines = 1024;  // fit into the processor's cache

/// R of J = Q R. Rows are added in blocks that fit into the processor's cache.
Eigen::MatrixXd triangle_by_parts(const Eigen::Ref<const Eigen::MatrixXd>& J) {
  const Eigen::Index count = J.cols(), part = std::max(kQrLines, 4 * count);
  Eigen::MatrixXd R(0, count);
  for (Eigen::Index first = 0; first < J.rows(); first += part) {
    const Eigen::Index lines = std::min(part, J.rows() - first);
    Eigen::MatrixXd stack(R.rows() + lines, count);
    stack << R, J.middleRows(first, lines);
    R = householder_triangle(stack);
  }
  return R;
}

}  // namespace

Orthonormal orthonormal(const Eigen::MatrixXd& J, Eigen::Index fit_lines) {
  const Eigen::VectorXd scale = per_norm(J.topRows(fit_lines));
  const Eigen::MatrixXd scaled = J * scale.asDiagonal();
  const PivotedQr qr(triangle_by_parts(scaled.topRows(fit_lines)), kIndependent);
  const Eigen::Index rank = qr.rank();
  Orthonormal out;
  const Eigen::MatrixXd R = qr.triangle(rank);
  out.U = divided_by_upper(qr.ordered(scaled).leftCols(rank), R);
  out.half = Eigen::MatrixXd::Zero(J.cols(), rank);
  out.half.topRows(rank) = upper_solved(R, Eigen::MatrixXd::Identity(rank, rank));
  out.half = scale.asDiagonal() * qr.in_place(out.half);
  return out;
}

}  // namespace plumb::offline
