// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "lane_order.hpp"
#include "lanes.hpp"
#include "plumb/runtime/detail/elementary.hpp"

namespace plumb::internal {

/// A rotation matrix by its columns, whose fourth lanes are arbitrary.
struct Turn {
  Lanes x, y, z;

  explicit Turn(const std::array<Lanes, 3>& columns)
      : x(columns[0]), y(columns[1]), z(columns[2]) {}
  explicit Turn(const std::array<std::array<double, 4>, 3>& stored)
      : x(lanes(stored[0].data())), y(lanes(stored[1].data())), z(lanes(stored[2].data())) {}
  explicit Turn(const Matrix3& R)
      : x(lanes(R.data())), y(lanes(R.data() + 3)), z(last_three(lanes(R.data() + 5))) {}

  Lanes operator*(const Lanes& v) const {
    return x * spread_lane<0>(v) + y * spread_lane<1>(v) + z * spread_lane<2>(v);
  }
  /// Reads R number by number: it may have been written in another size, and a read as registers
  /// would then have to wait for these writes.
  Turn operator*(const Matrix3& R) const {
    const auto column = [&](const double* v) { return x * v[0] + y * v[1] + z * v[2]; };
    return Turn(std::array{column(R.data()), column(R.data() + 3), column(R.data() + 6)});
  }

  void store(std::array<std::array<double, 4>, 3>& out) const {
    plumb::store(x, out[0].data());
    plumb::store(y, out[1].data());
    plumb::store(z, out[2].data());
  }

  /// Stores in whole registers, the last of which ends where the matrix does.
  void store(Matrix3& out) const {
    plumb::store(x, out.data());
    plumb::store(y, out.data() + 3);
    plumb::store(Lanes{y[2], z[0], z[1], z[2]}, out.data() + 5);
  }
};

inline constexpr double kSmallAngle = 1e-2;  // below it the series are exact to rounding

/// The coefficients of a rotation by the angle t and of its twist: a = sin(t) / t,
/// b = (1 - cos t) / t^2, c = (t - sin t) / t^3.
struct ExpCoefficients {
  Lanes all;  // a, b, c and an unused number
  double t2;  // t^2

  double b() const { return all[1]; }
  double c() const { return all[2]; }
};

/// The coefficients of a rotation whose squared angle is t2. For small angles the three series have
/// the same form and are summed together.
inline ExpCoefficients exp_coefficients(double t2) {
  if (t2 < kSmallAngle * kSmallAngle) {
    const Lanes first{1.0, 0.5, 1.0 / 6, 0.0}, second{1.0 / 6, 1.0 / 24, 1.0 / 120, 0.0};
    const Lanes third{1.0 / 120, 1.0 / 720, 1.0 / 5040, 0.0};
    const Lanes last{1.0 / 5040, 1.0 / 40320, 1.0 / 362880, 0.0};
    return {first - (second - (third - last * t2) * t2) * t2, t2};
  }
  const double t = portable::sqrt(t2);
  const auto half = portable::sin_cos(0.5 * t);
  const double sine = 2.0 * half.sin * half.cos;
  return {Lanes{sine / t, 2.0 * half.sin * half.sin / t2, (t - sine) / (t2 * t), 0.0}, t2};
}

/// The rotation by the vector e: I (1 - b t^2) + b e e^T + a [e]x.
inline Turn turn(const Lanes& e, const ExpCoefficients& k) {
  const Lanes a = spread_lane<0>(k.all), b = spread_lane<1>(k.all), be = b * e;
  const auto rest = cross_columns(a * e, broadcast(1.0) - b * k.t2);
  return Turn(std::array{spread_lane<0>(be) * e + rest[0], middle_products(be, e) + rest[1],
                         be * spread_lane<2>(e) + rest[2]});
}

/// The rotation by the rotation vector e [rad].
inline Turn turn(const Lanes& e) {
  const Lanes squares = e * e;
  return turn(e, exp_coefficients(squares[0] + squares[1] + squares[2]));
}

}  // namespace plumb::internal
