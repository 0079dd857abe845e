// SPDX-License-Identifier: Apache-2.0
#include "normal_equations.hpp"

namespace plumb::internal {
namespace {

/// Pivots below it belong to singular values below 1e-7: rounding, not geometry.
constexpr double kTinyPivot = 1e-14;

/// Brings the largest entry of column k, from row k down, into row k; -1 if rows were swapped.
int swap_in_pivot(Matrix6& A, int k) noexcept {
  int largest = k;
  for (int i = k + 1; i < 6; ++i)
    if (A(i, k) * A(i, k) > A(largest, k) * A(largest, k)) largest = i;
  for (int j = k; j < 6; ++j) {
    const double held = A(k, j);
    A(k, j) = A(largest, j);
    A(largest, j) = held;
  }
  return largest == k ? 1 : -1;
}

}  // namespace

Matrix6 gram(const Jacobian& J, int n) noexcept {
  Matrix6 A;
  for (int j = 0; j < 6; ++j) {
    // Whole columns in one local array: six independent sums the compiler may keep in registers.
    double sum[6] = {};
    for (int k = 0; k < n; ++k) {
      const double* column = J.data() + 6 * k;
      for (int i = 0; i < 6; ++i) sum[i] += column[i] * column[j];
    }
    for (int i = 0; i < 6; ++i) A(i, j) = sum[i];
  }
  return A;
}

Ldl factor(const Matrix6& A) noexcept {
  Ldl f{.L = A, .d = Vector6::Zero()};
  for (int k = 0; k < 6; ++k) {
    f.d(k) = f.L(k, k);
    const double inverse = f.d(k) == 0.0 ? 0.0 : 1.0 / f.d(k);
    for (int j = k + 1; j < 6; ++j) {
      const double l = f.L(j, k) * inverse;
      for (int i = j; i < 6; ++i) f.L(i, j) -= l * f.L(i, k);
    }
    for (int i = k + 1; i < 6; ++i) f.L(i, k) *= inverse;
  }
  return f;
}

Vector6 Ldl::solve(const Vector6& b) const noexcept {
  Vector6 x = b;
  for (int j = 0; j < 6; ++j)
    for (int i = j + 1; i < 6; ++i) x(i) -= L(i, j) * x(j);
  for (int i = 0; i < 6; ++i) x(i) = d(i) > kTinyPivot ? x(i) / d(i) : 0.0;
  for (int j = 5; j >= 0; --j)
    for (int i = j + 1; i < 6; ++i) x(j) -= L(i, j) * x(i);
  return x;
}

int Ldl::positive_pivots(int rows) const noexcept {
  int count = 0;
  for (int i = 0; i < rows; ++i) count += d(i) > 0.0 ? 1 : 0;
  return count;
}

RankAbove rank_above(double s, const Matrix6& JJt) noexcept {
  Matrix6 shifted = JJt;
  for (int i = 0; i < 6; ++i) shifted(i, i) -= s * s;
  const Ldl f = factor(shifted);
  return {.position = f.positive_pivots(3), .pose = f.positive_pivots(6)};
}

JointVector minimum_norm_step(const Jacobian& J, int n, const Vector6& r) noexcept {
  const Vector6 y = factor(gram(J, n)).solve(r);
  JointVector dq = JointVector::Zero();
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < 6; ++i) dq(k) += J(i, k) * y(i);
  return dq;
}

int determinant_sign(const Jacobian& J) noexcept {
  Matrix6 A = J.leftCols<6>();
  int sign = 1;
  for (int k = 0; k < 6; ++k) {
    sign *= swap_in_pivot(A, k);
    if (A(k, k) == 0.0) return 0;
    if (A(k, k) < 0.0) sign = -sign;
    for (int i = k + 1; i < 6; ++i) {
      const double l = A(i, k) / A(k, k);
      for (int j = k + 1; j < 6; ++j) A(i, j) -= l * A(k, j);
    }
  }
  return sign;
}

}  // namespace plumb::internal
