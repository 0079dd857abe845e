// SPDX-License-Identifier: Apache-2.0
#include "fit/orthonormal.hpp"

#include <Eigen/QR>
#include <algorithm>

namespace plumb::offline {
namespace {

constexpr double kIndependent = 1e-9;
constexpr Eigen::Index kQrLines = 1024;

/// R of J = Q R, a part of the rows at a time: what does not fit into the processor's cache is
/// slow.
Eigen::MatrixXd triangle_of(const Eigen::Ref<const Eigen::MatrixXd>& J) {
  const Eigen::Index count = J.cols(), part = std::max(kQrLines, 4 * count);
  Eigen::MatrixXd R(0, count);
  for (Eigen::Index first = 0; first < J.rows(); first += part) {
    const Eigen::Index lines = std::min(part, J.rows() - first);
    Eigen::MatrixXd stack(R.rows() + lines, count);
    stack << R, J.middleRows(first, lines);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(stack);
    R = qr.matrixQR()
            .topRows(std::min(stack.rows(), count))
            .template triangularView<Eigen::Upper>();
  }
  return R;
}

}  // namespace

Orthonormal orthonormal(const Eigen::MatrixXd& J, Eigen::Index fit_lines) {
  const Eigen::VectorXd scale =
      J.topRows(fit_lines).colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = J * scale.asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(triangle_of(scaled.topRows(fit_lines)));
  qr.setThreshold(kIndependent);
  const Eigen::Index rank = qr.rank();
  Orthonormal out;
  out.U = (scaled * qr.colsPermutation()).leftCols(rank);
  const Eigen::MatrixXd R = qr.matrixQR().topLeftCorner(rank, rank);
  R.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(out.U);
  out.half = Eigen::MatrixXd::Zero(J.cols(), rank);
  out.half.topRows(rank) =
      R.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(rank, rank));
  out.half = scale.asDiagonal() * (qr.colsPermutation() * out.half);
  return out;
}

}  // namespace plumb::offline
