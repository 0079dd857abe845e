// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scaled_jacobian.hpp"

/// The 6 x 6 linear algebra of the inverse correction: fixed size, fixed order, fixed cost.
namespace plumb::internal {

using Vector6 = Eigen::Matrix<double, 6, 1, Eigen::DontAlign>;

/// 6 x 6, a motion a column.
struct Matrix6 {
  std::array<TipMotion, 6> column;

  double operator()(std::size_t i, std::size_t j) const noexcept {
    return i < 3 ? column[j].translation[i] : column[j].rotation[i - 3];
  }
};
using JointVector = Eigen::Matrix<double, kMaxJoints, 1, Eigen::DontAlign>;

/// The lower triangle of J J^T; above its diagonal stands what means nothing.
Matrix6 gram(const ScaledJacobian& J) noexcept;

/// A = L D L^T without pivoting: L unit lower triangular in `L`, D in `d`; above the diagonal of L
/// stands what means nothing.
/// By Sylvester's law of inertia A has as many positive eigenvalues as `d` positive entries, and so
/// has each leading block.
struct Ldl {
  Matrix6 L;
  Vector6 d;

  /// x of A x = b; a pivot that is not positive counts as infinite, so x stays finite.
  Vector6 solve(const Vector6& b) const noexcept;

  /// Positive entries among the first `rows`.
  int positive_pivots(int rows) const noexcept;
};

/// Reads the lower triangle of A.
Ldl factor(const Matrix6& A) noexcept;

/// How many singular values of the first rows of J exceed s, without computing one.
struct RankAbove {
  int position;  // of rows 0-2
  int pose;      // of all rows
};
RankAbove rank_above(double s, Matrix6 JJt) noexcept;

/// Shortest step with J dq = r: J^T (J J^T)^-1 r. n >= 6.
JointVector minimum_norm_step(const ScaledJacobian& J, const Vector6& r) noexcept;

}  // namespace plumb::internal
