// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/transform.hpp"

namespace plumb {
namespace {

constexpr double kSmallAngle = 1e-2;  // below it the series are exact to rounding

struct ExpCoefficients {
  double a;  // sin(t) / t
  double b;  // (1 - cos t) / t^2
  double c;  // (t - sin t) / t^3
};

ExpCoefficients exp_coefficients(double t2) noexcept {
  if (t2 < kSmallAngle * kSmallAngle)
    return {1.0 - t2 / 6.0 * (1.0 - t2 / 20.0 * (1.0 - t2 / 42.0)),
            0.5 * (1.0 - t2 / 12.0 * (1.0 - t2 / 30.0 * (1.0 - t2 / 56.0))),
            (1.0 - t2 / 20.0 * (1.0 - t2 / 42.0 * (1.0 - t2 / 72.0))) / 6.0};
  const double t = portable::sqrt(t2);
  const auto half = portable::sin_cos(0.5 * t);
  const double sine = 2.0 * half.sin * half.cos;
  return {sine / t, 2.0 * half.sin * half.sin / t2, (t - sine) / (t2 * t)};
}

Matrix3 skew(const Vector3& v) noexcept {
  Matrix3 m;
  m << 0.0, -v(2), v(1), v(2), 0.0, -v(0), -v(1), v(0), 0.0;
  return m;
}

/// Unit quaternion (w, x, y, z), w >= 0, by the largest of its four squares [Shepperd 1978].
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

Transformd exp(const format::Twist& xi) noexcept {
  const Vector3 d(xi.d[0], xi.d[1], xi.d[2]);
  const Vector3 e(xi.e[0], xi.e[1], xi.e[2]);
  const auto [a, b, c] = exp_coefficients(dot(e, e));
  const Vector3 ed = cross<double>(e, d);
  Transformd X;
  const Matrix3 K = skew(e);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      X.R(i, j) = (i == j ? 1.0 - b * dot(e, e) : 0.0) + a * K(i, j) + b * (e(i) * e(j));
  X.p = d + b * ed + c * cross<double>(e, ed);
  return X;
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
