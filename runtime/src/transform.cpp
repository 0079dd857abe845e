// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/transform.hpp"

#include "lanes.hpp"

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
    return {1.0 - t2 * (1.0 / 6 - t2 * (1.0 / 120 - t2 * (1.0 / 5040))),
            0.5 - t2 * (1.0 / 24 - t2 * (1.0 / 720 - t2 * (1.0 / 40320))),
            1.0 / 6 - t2 * (1.0 / 120 - t2 * (1.0 / 5040 - t2 * (1.0 / 362880)))};
  const double t = portable::sqrt(t2);
  const auto half = portable::sin_cos(0.5 * t);
  const double sine = 2.0 * half.sin * half.cos;
  return {sine / t, 2.0 * half.sin * half.sin / t2, (t - sine) / (t2 * t)};
}

/// 1 - b t^2 + b e e^T + a [e]x
Matrix3 rotation(const Vector3& e, double t2, double a, double b) noexcept {
  const double rest = 1.0 - b * t2;
  const Vector3 be = b * e, ae = a * e;
  const double xy = be(0) * e(1), xz = be(0) * e(2), yz = be(1) * e(2);
  Matrix3 R;
  R.col(0) = Vector3(rest + be(0) * e(0), xy + ae(2), xz - ae(1));
  R.col(1) = Vector3(xy - ae(2), rest + be(1) * e(1), yz + ae(0));
  R.col(2) = Vector3(xz + ae(1), yz - ae(0), rest + be(2) * e(2));
  return R;
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

Matrix3 product(const Matrix3& A, const Matrix3& B) noexcept {
  Lanes x, y, end;
  std::memcpy(&x, A.data(), sizeof x);
  std::memcpy(&y, A.data() + 3, sizeof y);
  std::memcpy(&end, A.data() + 5, sizeof end);
  const Lanes z = last_three(end);
  const auto column = [&](const double* b) { return x * b[0] + y * b[1] + z * b[2]; };
  const Lanes X = column(B.data()), Y = column(B.data() + 3), Z = column(B.data() + 6);
  const Lanes last{Y[2], Z[0], Z[1], Z[2]};
  Matrix3 out;
  std::memcpy(out.data(), &X, sizeof X);
  std::memcpy(out.data() + 3, &Y, sizeof Y);
  std::memcpy(out.data() + 5, &last, sizeof last);
  return out;
}

Transformd exp(const format::Twist& xi) noexcept {
  const Vector3 d(xi.d[0], xi.d[1], xi.d[2]);
  const Vector3 e(xi.e[0], xi.e[1], xi.e[2]);
  const double t2 = dot(e, e);
  const auto [a, b, c] = exp_coefficients(t2);
  const Vector3 ed = cross<double>(e, d);
  return {.R = rotation(e, t2, a, b), .p = d + b * ed + c * cross<double>(e, ed)};
}

Matrix3 rotation_of(const Vector3& e) noexcept {
  const double t2 = dot(e, e);
  const ExpCoefficients k = exp_coefficients(t2);
  return rotation(e, t2, k.a, k.b);
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
