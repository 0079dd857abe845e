// SPDX-License-Identifier: Apache-2.0
#include "check/linear_placement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "numbers/pivoted_qr.hpp"
#include "numbers/rotation_fit.hpp"
#include "numbers/triangle.hpp"

namespace plumb::offline {
namespace {

/// Share of the target's information that is added to it: a target that no pose shows becomes 0.
constexpr double kPlacementRidge = 1e-9;
/// A cloud of points is flat if it is thinner than this share of its size.
constexpr double kFlatCloud = 1e-6;
/// Misfit of an arm whose points do not move, so that it has no scale.
constexpr double kHugeMisfit = 1e12;

}  // namespace

LinearPlacer::LinearPlacer(const Rows3& p_M, const std::array<bool, 3>& has_axis) {
  const Eigen::Index n = p_M.rows();
  for (int k = 0; k < 3; ++k)
    if (has_axis[k]) axis_[axes_++] = k;
  Eigen::MatrixXd A(n, axes_ + 1);
  for (Eigen::Index k = 0; k < axes_; ++k) {
    A.col(k) = p_M.col(axis_[k]);
    size_ += (A.col(k).array() - A.col(k).mean()).square().sum();
  }
  A.col(axes_).setOnes();
  size_ = std::sqrt(size_ / static_cast<double>(n));
  Rows3 centred = p_M.rowwise() - p_M.colwise().mean();
  for (int k = 0; k < 3; ++k)
    if (!has_axis[k]) centred.col(k).setZero();
  spread_ = centred.transpose() * centred / static_cast<double>(n);
  const PivotedQr qr(A, kFlatCloud);
  const Eigen::Index rank = qr.rank();
  basis_ = qr.basis(rank);
  Eigen::MatrixXd R_inverse = Eigen::MatrixXd::Zero(axes_ + 1, rank);
  R_inverse.topRows(rank) = upper_solved(qr.triangle(rank), Eigen::MatrixXd::Identity(rank, rank));
  to_map_ = qr.in_place(R_inverse);
  sides_.resize(n, 12);
  rows_ = Columns4::Zero(4, n);
  rows_.topRows(rank) = basis_.transpose();
}

double LinearPlacer::quick_misfit(const std::vector<Transformd>& X_BT) const {
  const auto n = static_cast<double>(rows_.cols());
  using Coefficients = Eigen::Matrix<double, 4, 12>;  // as coefficients_
  Coefficients all = Coefficients::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  double whole = 0.0;
  for (Eigen::Index i = 0; i < rows_.cols(); ++i) {
    const Transformd& X = X_BT[static_cast<std::size_t>(i)];
    const Eigen::Vector4d row = rows_.col(i);
    for (int k = 0; k < 3; ++k) {
      all.col(k) += row * X.p(k);
      for (int c = 0; c < 3; ++c) all.col(3 + 3 * k + c) += row * X.R(k, c);
    }
    g -= X.R.transpose() * X.p;
    whole += X.p.squaredNorm();
  }
  Eigen::Matrix3d N = n * (1.0 + kPlacementRidge) * Eigen::Matrix3d::Identity();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Matrix<double, 4, 3> cR = all.middleCols<3>(3 + 3 * k);
    N -= cR.transpose() * cR;
    g += cR.transpose() * all.col(k);
    whole -= all.col(k).squaredNorm();
  }
  const Eigen::Vector3d target_T = N.ldlt().solve(g);
  const double left = std::max(0.0, whole - g.dot(target_T));
  double squares = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector4d map = all.col(k) + all.middleCols<3>(3 + 3 * k) * target_T;
    for (Eigen::Index c = 0; c < axes_; ++c) {
      double one = 0.0;
      for (Eigen::Index r = 0; r < to_map_.cols(); ++r) one += to_map_(c, r) * map(r);
      squares += one * one;
    }
  }
  const double unit = std::sqrt(squares / static_cast<double>(axes_)) * size_;
  return unit > 0.0 ? std::sqrt(left / n) / unit : kHugeMisfit;
}

LinearPlacement LinearPlacer::place(const std::vector<Transformd>& X_BT) {
  const Eigen::Index n = sides_.rows();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Transformd& X = X_BT[i];
    for (int k = 0; k < 3; ++k) {
      sides_(i, k) = X.p(k);
      for (int c = 0; c < 3; ++c) sides_(i, 3 + 3 * k + c) = X.R(k, c);
    }
  }
  coefficients_.noalias() = basis_.transpose() * sides_;
  // Normal equations of t with M and b eliminated: sides minus their projection on the basis.
  Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  double whole = 0.0;
  for (int k = 0; k < 3; ++k) {
    const auto p = sides_.col(k);
    const auto R = sides_.middleCols<3>(3 + 3 * k);
    const auto cp = coefficients_.col(k);
    const auto cR = coefficients_.middleCols<3>(3 + 3 * k);
    N += (R.transpose() * R).eval() - (cR.transpose() * cR).eval();
    g -= (R.transpose() * p).eval() - (cR.transpose() * cp).eval();
    whole += p.squaredNorm() - cp.squaredNorm();
  }
  LinearPlacement out;
  const Eigen::Matrix3d ridged =
      N + kPlacementRidge * static_cast<double>(n) * Eigen::Matrix3d::Identity();
  out.target_T = ridged.ldlt().solve(g);
  out.left = std::max(0.0, whole - g.dot(out.target_T));
  for (int k = 0; k < 3; ++k) {
    const Eigen::VectorXd map =
        to_map_ * (coefficients_.col(k) + coefficients_.middleCols<3>(3 + 3 * k) * out.target_T);
    for (Eigen::Index c = 0; c < axes_; ++c) out.M(k, axis_[c]) = map(c);
  }
  out.ratio = out.M.norm() / std::sqrt(static_cast<double>(axes_));
  out.left_handed = axes_ == 3 && out.M.determinant() < 0.0;
  const double unit = out.ratio * size_;
  out.misfit = unit > 0.0 ? std::sqrt(out.left / static_cast<double>(n)) / unit : kHugeMisfit;
  return out;
}

void LinearPlacer::tighten(LinearPlacement& placement) const {
  // min over s, Q of tr[(M - s Q) C (M - s Q)^T]: Q from the SVD of M C, s = sum of its singular
  // values over tr C.
  const auto [Q, sum] = nearest_orthogonal(placement.M * spread_);
  placement.ratio = sum / spread_.trace();
  placement.left_handed = axes_ == 3 && Q.determinant() < 0.0;
  const Eigen::Matrix3d off = placement.M - placement.ratio * Q;
  const double away = (off * spread_ * off.transpose()).trace();
  const double all = placement.left / static_cast<double>(sides_.rows()) + std::max(0.0, away);
  const double unit = placement.ratio * size_;
  placement.misfit = unit > 0.0 ? std::sqrt(all) / unit : kHugeMisfit;
}

}  // namespace plumb::offline
