// SPDX-License-Identifier: Apache-2.0
#include "priority_step.hpp"

#include <algorithm>

namespace plumb::internal {
namespace {

constexpr double kTiny = 1e-14;  // a squared length: singular values below 1e-7 are rounding errors

constexpr int kFewJoints = 5;  // arms with more joints use other steps

/// Three rows of a Jacobian with at most five joints; columns beyond the last joint are zero.
using Rows = Eigen::Matrix<double, 3, kFewJoints, Eigen::DontAlign>;

double row_dot(const Rows& a, int i, const Rows& b, int j) noexcept {
  double sum = 0.0;
  for (int k = 0; k < kFewJoints; ++k) sum += a(i, k) * b(j, k);
  return sum;
}

/// row i of a -= factor * row j of b.
void subtract_row(Rows& a, int i, double factor, const Rows& b, int j) noexcept {
  for (int k = 0; k < kFewJoints; ++k) a(i, k) -= factor * b(j, k);
}

/// Orthonormal basis of the `rank` strongest directions of the row space, the longest row first.
/// Rows from `rank` on, and directions that are not there, are zero.
Rows row_basis(Rows rows, int rank) noexcept {
  Rows basis = Rows::Zero();
  for (int b = 0; b < rank; ++b) {
    int longest = 0;
    for (int i = 1; i < 3; ++i)
      if (row_dot(rows, i, rows, i) > row_dot(rows, longest, rows, longest)) longest = i;
    const double length2 = row_dot(rows, longest, rows, longest);
    if (length2 > kTiny) subtract_row(basis, b, -1.0 / portable::sqrt(length2), rows, longest);
    for (int i = 0; i < 3; ++i) subtract_row(rows, i, row_dot(rows, i, basis, b), basis, b);
  }
  return basis;
}

/// Least squares y of |B y - r| for B (3, 3), by Cholesky of B^T B; a zero column gives y = 0.
Vector3 least_squares(const Matrix3& B, const Vector3& r) noexcept {
  Matrix3 L;
  Vector3 d, y;
  for (int j = 0; j < 3; ++j) {
    for (int i = j; i < 3; ++i) L(i, j) = dot(B.col(i), B.col(j));
    y(j) = dot(B.col(j), r);
  }
  for (int k = 0; k < 3; ++k) {
    d(k) = L(k, k) > kTiny ? 1.0 / L(k, k) : 0.0;
    for (int j = k + 1; j < 3; ++j)
      for (int i = j; i < 3; ++i) L(i, j) -= L(i, k) * L(j, k) * d(k);
  }
  for (int k = 0; k < 3; ++k)
    for (int i = k + 1; i < 3; ++i) y(i) -= L(i, k) * d(k) * y(k);
  for (int k = 2; k >= 0; --k) {
    y(k) *= d(k);
    for (int i = k + 1; i < 3; ++i) y(k) -= L(i, k) * d(k) * y(i);
  }
  return y;
}

/// A b with the rows of `basis` as columns of b.
Matrix3 on_basis(const Rows& rows, const Rows& basis) noexcept {
  Matrix3 B;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) B(i, j) = row_dot(rows, i, basis, j);
  return B;
}

void add_along(JointVector& dq, const Rows& basis, const Vector3& y) noexcept {
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < kFewJoints; ++k) dq(k) += basis(j, k) * y(j);
}

}  // namespace

JointVector priority_step(const Jacobian& J, const Controllable& can, const Vector6& r) noexcept {
  const Rows position = J.topLeftCorner<3, kFewJoints>();
  Rows orientation = J.bottomLeftCorner<3, kFewJoints>();
  JointVector dq = JointVector::Zero();

  const Rows first = row_basis(position, can.position);
  const Vector3 along_first = least_squares(on_basis(position, first), r.head<3>());
  add_along(dq, first, along_first);

  const Matrix3 coupling = on_basis(orientation, first);
  const Vector3 left = Vector3(r.tail<3>()) - times<double>(coupling, along_first);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) subtract_row(orientation, i, coupling(i, j), first, j);
  const Rows second = row_basis(orientation, can.pose - can.position);
  add_along(dq, second, least_squares(on_basis(orientation, second), left));
  return dq;
}

}  // namespace plumb::internal
