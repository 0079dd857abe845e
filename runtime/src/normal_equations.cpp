// SPDX-License-Identifier: Apache-2.0
#include "normal_equations.hpp"

namespace plumb::internal {
namespace {

/// Pivots below it belong to singular values below 1e-7: rounding, not geometry.
constexpr double kTinyPivot = 1e-14;

}  // namespace

Matrix6 gram(const Jacobian& J, int n) noexcept {
  const Lanes zero{0.0, 0.0, 0.0, 0.0};
  Matrix6 A;
  for (auto& column : A.column) column = {zero, zero};
  for (int k = 0; k < n; ++k) {
    const Lanes top{J(0, k), J(1, k), J(2, k), J(3, k)};
    const Lanes bottom{J(4, k), J(5, k), 0.0, 0.0};
    for (int j = 0; j < 6; ++j) {
      auto& column = A.column[static_cast<std::size_t>(j)];
      column.top = column.top + top * J(j, k);
      column.bottom = column.bottom + bottom * J(j, k);
    }
  }
  return A;
}

Ldl factor(const Matrix6& A) noexcept {
  Ldl f{.L = A, .d = Vector6::Zero()};
  for (std::size_t k = 0; k < 6; ++k) {
    auto& pivot = f.L.column[k];
    const double d = f.L(k, k);
    const double inverse = d == 0.0 ? 0.0 : 1.0 / d;
    for (std::size_t j = k + 1; j < 6; ++j) {
      const double l = f.L(j, k) * inverse;
      f.L.column[j].top = f.L.column[j].top - pivot.top * l;
      f.L.column[j].bottom = f.L.column[j].bottom - pivot.bottom * l;
    }
    pivot.top = pivot.top * inverse;
    pivot.bottom = pivot.bottom * inverse;
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

RankAbove rank_above(double s, const Matrix6& JJt) noexcept {
  const double s2 = s * s;
  Matrix6 shifted = JJt;
  shifted.column[0].top = JJt.column[0].top - Lanes{s2, 0.0, 0.0, 0.0};
  shifted.column[1].top = JJt.column[1].top - Lanes{0.0, s2, 0.0, 0.0};
  shifted.column[2].top = JJt.column[2].top - Lanes{0.0, 0.0, s2, 0.0};
  shifted.column[3].top = JJt.column[3].top - Lanes{0.0, 0.0, 0.0, s2};
  shifted.column[4].bottom = JJt.column[4].bottom - Lanes{s2, 0.0, 0.0, 0.0};
  shifted.column[5].bottom = JJt.column[5].bottom - Lanes{0.0, s2, 0.0, 0.0};
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

}  // namespace plumb::internal
