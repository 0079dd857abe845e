// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/transform.hpp"

#include "turn.hpp"

namespace plumb {
namespace {

/// The unit quaternion (w, x, y, z) with w >= 0, computed from its largest component [Shepperd
/// 1978].
std::array<double, 4> quaternion(const Matrix3& R) noexcept {
  const std::array<double, 4> squares{
      1.0 + R(0, 0) + R(1, 1) + R(2, 2), 1.0 + R(0, 0) - R(1, 1) - R(2, 2),
      1.0 - R(0, 0) + R(1, 1) - R(2, 2), 1.0 - R(0, 0) - R(1, 1) + R(2, 2)};
  int largest = 0;
  for (int i = 1; i < 4; ++i)
    if (squares[i] > squares[largest]) largest = i;
  const double wx = R(2, 1) - R(1, 2), wy = R(0, 2) - R(2, 0), wz = R(1, 0) - R(0, 1);
  const double xy = R(1, 0) + R(0, 1), xz = R(0, 2) + R(2, 0), yz = R(2, 1) + R(1, 2);
  const double s = squares[largest];
  std::array<double, 4> q{};
  switch (largest) {
    case 0:
      q = {s, wx, wy, wz};
      break;
    case 1:
      q = {wx, s, xy, xz};
      break;
    case 2:
      q = {wy, xy, s, yz};
      break;
    default:
      q = {wz, xz, yz, s};
  }
  double norm2 = 0.0;
  for (double x : q) norm2 += x * x;
  const double scale = (q[0] < 0.0 ? -1.0 : 1.0) / portable::sqrt(norm2);
  for (double& x : q) x *= scale;
  return q;
}

}  // namespace

Matrix3 product(const Matrix3& A, const Matrix3& B) noexcept {
  Matrix3 out;
  (internal::Turn(A) * B).store(out);
  return out;
}

Transformd exp(const format::Twist& xi) noexcept {
  const Vector3 d(xi.d[0], xi.d[1], xi.d[2]);
  const Vector3 e(xi.e[0], xi.e[1], xi.e[2]);
  const auto k = internal::exp_coefficients(dot(e, e));
  const Vector3 ed = cross<double>(e, d);
  Transformd X;
  internal::turn(Lanes{e(0), e(1), e(2), 0.0}, k).store(X.R);
  X.p = d + k.b() * ed + k.c() * cross<double>(e, ed);
  return X;
}

Matrix3 rotation_of(const Vector3& e) noexcept {
  Matrix3 out;
  internal::turn(Lanes{e(0), e(1), e(2), 0.0}).store(out);
  return out;
}

Vector3 rotation_vector(const Matrix3& R) noexcept {
  const auto q = quaternion(R);
  const Vector3 v(q[1], q[2], q[3]);
  const double sine = portable::sqrt(dot(v, v));
  // angle / sin(angle / 2), from the series of asin near zero.
  const double s2 = sine * sine;
  const double factor = sine < 1e-3 ? 2.0 * (1.0 + s2 / 6.0 * (1.0 + s2 * 0.45))
                                    : 2.0 * portable::atan2(sine, q[0]) / sine;
  return factor * v;
}

Transformd from_pose(const format::Pose& pose) noexcept {
  const auto [w, x, y, z] = pose.q;
  Transformd X;
  X.R << 1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),
      2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),
      2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y);
  X.p = Vector3(pose.p[0], pose.p[1], pose.p[2]);
  return X;
}

format::Pose to_pose(const Transformd& X) noexcept {
  return {{X.p(0), X.p(1), X.p(2)}, quaternion(X.R)};
}

Transformd rot_x(double angle) noexcept {
  const auto [s, c] = portable::sin_cos(angle);
  Transformd X;
  X.R << 1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c;
  return X;
}

Transformd rot_y(double angle) noexcept {
  const auto [s, c] = portable::sin_cos(angle);
  Transformd X;
  X.R << c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c;
  return X;
}

Transformd rot_z(double angle) noexcept {
  const auto [s, c] = portable::sin_cos(angle);
  Transformd X;
  X.R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return X;
}

Transformd translation(double x, double y, double z) noexcept {
  Transformd X;
  X.p = Vector3(x, y, z);
  return X;
}

}  // namespace plumb
