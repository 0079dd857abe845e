// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace plumb::offline {

/// A number with its exact derivatives in eight directions: laws of the runtime are evaluated with
/// it to differentiate them by their parameters. [Griewank & Walther 2008]
struct Dual {
  static constexpr int kLanes = 8;
  using Slopes = Eigen::Array<double, kLanes, 1, Eigen::DontAlign>;

  double v = 0.0;
  Slopes d = Slopes::Zero();

  Dual() = default;
  Dual(double value) : v(value) {}
  Dual(double value, const Slopes& slopes) : v(value), d(slopes) {}

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }

  friend Dual operator-(const Dual& a) { return {-a.v, -a.d}; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, a.d - b.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.v * b.v, a.d * b.v + b.d * a.v}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    return {a.v / b.v, (a.d - b.d * (a.v / b.v)) / b.v};
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    return {std::atan2(y.v, x.v), (y.d * x.v - x.d * y.v) / (x.v * x.v + y.v * y.v)};
  }
};

}  // namespace plumb::offline
