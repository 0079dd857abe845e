// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "plumb/format/model.hpp"
#include "plumb/runtime/detail/elementary.hpp"

namespace plumb {

template <class S>
using Vec3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Mat3 = Eigen::Matrix<S, 3, 3>;
using Vector3 = Vec3<double>;
using Matrix3 = Mat3<double>;

/// Dot product, summed in a fixed order so that the bits do not depend on vectorisation.
template <class A, class B>
auto dot(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a(0) * b(0) + a(1) * b(1) + a(2) * b(2);
}

template <class S>
Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
  return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

/// M v, summed column by column.
template <class S>
Vec3<S> times(const Mat3<S>& m, const Vec3<S>& v) {
  Vec3<S> out;
  for (int i = 0; i < 3; ++i) out(i) = m(i, 0) * v(0) + m(i, 1) * v(1) + m(i, 2) * v(2);
  return out;
}

/// M^T v.
template <class S>
Vec3<S> transpose_times(const Mat3<S>& m, const Vec3<S>& v) {
  Vec3<S> out;
  for (int i = 0; i < 3; ++i) out(i) = m(0, i) * v(0) + m(1, i) * v(1) + m(2, i) * v(2);
  return out;
}

/// A B^T, each element summed in a fixed order.
template <class S>
Mat3<S> times_transposed(const Mat3<S>& a, const Mat3<S>& b) {
  Mat3<S> out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      out(i, j) = a(i, 0) * b(j, 0) + a(i, 1) * b(j, 1) + a(i, 2) * b(j, 2);
  return out;
}

/// Pose X_AB of frame B in frame A: a point p_B is at R p_B + p in A [m].
/// In a product neighbouring letters are equal: X_AC = X_AB * X_BC.
template <class S>
struct Transform {
  Mat3<S> R = Mat3<S>::Identity();
  Vec3<S> p = Vec3<S>::Zero();

  friend Transform operator*(const Transform& X_AB, const Transform& X_BC) {
    Transform X_AC;
    for (int j = 0; j < 3; ++j) X_AC.R.col(j) = times<S>(X_AB.R, X_BC.R.col(j));
    X_AC.p = times<S>(X_AB.R, X_BC.p) + X_AB.p;
    return X_AC;
  }
  friend Vec3<S> operator*(const Transform& X_AB, const Vec3<S>& p_B) {
    return times<S>(X_AB.R, p_B) + X_AB.p;
  }
  Transform inverse() const {
    Transform X_BA;
    X_BA.R = R.transpose();
    X_BA.p = -transpose_times<S>(R, p);
    return X_BA;
  }
};

using Transformd = Transform<double>;

/// Exponential of a twist (d, e): rotation exp([e]x), translation V(e) d. Exact for any |e|, also
/// 0.
Transformd exp(const format::Twist& xi) noexcept;

/// A B, each column summed in a fixed order.
Matrix3 product(const Matrix3& A, const Matrix3& B) noexcept;

/// Rotation matrix of a rotation vector [rad].
Matrix3 rotation_of(const Vector3& e) noexcept;

/// Rotation vector of R [rad], |r| <= pi; the inverse of exp for pure rotations.
Vector3 rotation_vector(const Matrix3& R) noexcept;

Transformd from_pose(const format::Pose& pose) noexcept;

/// The quaternion of the result has w >= 0.
format::Pose to_pose(const Transformd& X) noexcept;

/// Elementary motions along and about the frame axes; angle [rad], length [m].
Transformd rot_x(double angle) noexcept;
Transformd rot_y(double angle) noexcept;
Transformd rot_z(double angle) noexcept;
Transformd translation(double x, double y, double z) noexcept;

}  // namespace plumb
