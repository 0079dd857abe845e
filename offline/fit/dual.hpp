// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "plumb/runtime/elementary.hpp"

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

  /// d times a slope that may be infinite where d is 0.
  Slopes times(double slope) const { return (d == 0.0).select(Slopes::Zero(), d * slope); }

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
  friend portable::SinCos<Dual> sin_cos(const Dual& a) {
    const auto t = portable::sin_cos(a.v);
    return {{t.sin, a.times(t.cos)}, {t.cos, a.times(-t.sin)}};
  }
  friend Dual exp(const Dual& a) {
    const double value = portable::exp(a.v);
    return {value, a.times(value)};
  }
  friend Dual log(const Dual& a) { return {portable::log(a.v), a.times(1.0 / a.v)}; }
  friend Dual sqrt(const Dual& a) {
    const double value = portable::sqrt(a.v);
    return {value, a.times(0.5 / value)};
  }
  friend Dual tanh(const Dual& a) {
    const double value = portable::tanh(a.v);
    return {value, a.times(1.0 - value * value)};
  }
  /// a^b = e^(b ln a); a power that does not change needs no logarithm.
  friend Dual pow(const Dual& a, const Dual& b) {
    const double value = portable::pow(a.v, b.v);
    const double by_a = b.v == 0.0 ? 0.0 : b.v * portable::pow(a.v, b.v - 1.0);
    const double by_b = value == 0.0 ? 0.0 : value * portable::log(a.v);
    return {value, a.times(by_a) + b.times(by_b)};
  }
  friend double plain(const Dual& a) { return a.v; }

  /// Value and slopes are finite.
  friend bool is_number(const Dual& a) { return std::isfinite(a.v) && a.d.isFinite().all(); }
};

}  // namespace plumb::offline
