// SPDX-License-Identifier: Apache-2.0
#include "normal_equations.hpp"

#include "uninitialised.hpp"

namespace plumb::internal {
namespace {

/// Pivots below it belong to singular values below 1e-7: rounding, not geometry.
constexpr double kTinyPivot = 1e-14;

}  // namespace

Matrix6 gram(const ScaledJacobian& J) noexcept {
  const Lanes zero{0.0, 0.0, 0.0, 0.0};
  Matrix6 A;
  A.column.fill({zero, zero});
  for (const TipMotion& column : J.columns()) {
    for (std::size_t j = 0; j < 3; ++j) {
      A.column[j].translation =
          A.column[j].translation + column.translation * column.translation[j];
      A.column[j].rotation = A.column[j].rotation + column.rotation * column.translation[j];
    }
    for (std::size_t j = 3; j < 6; ++j)
      A.column[j].rotation = A.column[j].rotation + column.rotation * column.rotation[j - 3];
  }
  return A;
}

Ldl factor(const Matrix6& A) noexcept {
  Ldl f;
  copy(A, f.L);
  for (std::size_t k = 0; k < 6; ++k) {
    TipMotion& pivot = f.L.column[k];
    const double d = f.L(k, k);
    const double inverse = d == 0.0 ? 0.0 : 1.0 / d;
    for (std::size_t j = k + 1; j < 6; ++j) {
      const double l = f.L(j, k) * inverse;
      TipMotion& other = f.L.column[j];
      if (j < 3) other.translation = other.translation - pivot.translation * l;
      other.rotation = other.rotation - pivot.rotation * l;
    }
    if (k < 3) pivot.translation = pivot.translation * inverse;
    pivot.rotation = pivot.rotation * inverse;
    f.d(static_cast<int>(k)) = d;
  }
  return f;
}

Vector6 Ldl::solve(const Vector6& b) const noexcept {
  Vector6 x = b;
  const auto at = [this](int i, int j) {
    return L(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  };
  for (int j = 0; j < 6; ++j)
    for (int i = j + 1; i < 6; ++i) x(i) -= at(i, j) * x(j);
  for (int i = 0; i < 6; ++i) x(i) = d(i) > kTinyPivot ? x(i) / d(i) : 0.0;
  for (int j = 5; j >= 0; --j)
    for (int i = j + 1; i < 6; ++i) x(j) -= at(i, j) * x(i);
  return x;
}

int Ldl::positive_pivots(int rows) const noexcept {
  int count = 0;
  for (int i = 0; i < rows; ++i) count += d(i) > 0.0 ? 1 : 0;
  return count;
}

RankAbove rank_above(double s, Matrix6 JJt) noexcept {
  const double s2 = s * s;
  const std::array<Lanes, 3> unit{Lanes{s2, 0.0, 0.0, 0.0}, Lanes{0.0, s2, 0.0, 0.0},
                                  Lanes{0.0, 0.0, s2, 0.0}};
  for (std::size_t i = 0; i < 3; ++i) {
    JJt.column[i].translation = JJt.column[i].translation - unit[i];
    JJt.column[i + 3].rotation = JJt.column[i + 3].rotation - unit[i];
  }
  const Ldl f = factor(JJt);
  return {.position = f.positive_pivots(3), .pose = f.positive_pivots(6)};
}

JointVector minimum_norm_step(const ScaledJacobian& J, const Vector6& r) noexcept {
  const Vector6 y = factor(gram(J)).solve(r);
  JointVector dq = JointVector::Zero();
  int k = 0;
  for (const TipMotion& column : J.columns()) {
    for (std::size_t i = 0; i < 3; ++i) dq(k) += column.translation[i] * y(static_cast<int>(i));
    for (std::size_t i = 0; i < 3; ++i) dq(k) += column.rotation[i] * y(static_cast<int>(i) + 3);
    ++k;
  }
  return dq;
}

}  // namespace plumb::internal
