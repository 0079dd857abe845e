// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scaled_jacobian.hpp"

/// The 6 x 6 linear algebra of the inverse correction: fixed size, fixed order, fixed cost.
namespace plumb::internal {

using Vector6 = Eigen::Matrix<double, 6, 1, Eigen::DontAlign>;

/// A 6 x 6 matrix, each column of which is a motion of the tip.
struct Matrix6 {
  std::array<TipMotion, 6> column;

  double operator()(std::size_t i, std::size_t j) const noexcept {
    return i < 3 ? column[j].translation[i] : column[j].rotation[i - 3];
  }
};
using JointVector = Eigen::Matrix<double, kMaxJoints, 1, Eigen::DontAlign>;

/// The lower triangle of J J^T; the elements above the diagonal are arbitrary.
Matrix6 gram(const ScaledJacobian& J) noexcept;

/// The factors of A = L D L^T without pivoting: the unit lower triangular L and the diagonal d of
/// D. The elements of L above the diagonal are arbitrary. By Sylvester's law of inertia, A has as
/// many positive eigenvalues as d has positive entries, and the same holds for each leading block.
struct Ldl {
  Matrix6 L;
  Vector6 d;

  /// Solves A x = b. A pivot that is not positive counts as infinite, so that x stays finite.
  Vector6 solve(const Vector6& b) const noexcept;

  /// The number of positive entries among the first `rows` of d.
  int positive_pivots(int rows) const noexcept;
};

/// Factors A, of which only the lower triangle is read.
Ldl factor(const Matrix6& A) noexcept;

/// The number of singular values of J above s, which is found without computing any of them.
struct RankAbove {
  int position;  // singular values of rows 0-2
  int pose;      // singular values of all rows
};
RankAbove rank_above(double s, Matrix6 JJt) noexcept;

/// Shortest step with J dq = r: J^T (J J^T)^-1 r. n >= 6.
JointVector minimum_norm_step(const ScaledJacobian& J, const Vector6& r) noexcept;

}  // namespace plumb::internal
