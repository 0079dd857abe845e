// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "plumb/runtime/detail/elementary.hpp"

namespace plumb::offline {

/// A number with its exact derivatives in some directions: laws of the runtime are evaluated with
/// it to differentiate them by their parameters. [Griewank & Walther 2008]
template <int kDirections>
struct DualOf {
  static constexpr int kLanes = kDirections;
  using Slopes = Eigen::Array<double, kLanes, 1, Eigen::DontAlign>;

  double v = 0.0;
  Slopes d = Slopes::Zero();

  DualOf() = default;
  DualOf(double value) : v(value) {}
  DualOf(double value, const Slopes& slopes) : v(value), d(slopes) {}

  /// d times a slope that may be infinite where d is 0.
  Slopes times(double slope) const { return (d == 0.0).select(Slopes::Zero(), d * slope); }

  DualOf& operator+=(const DualOf& b) { return *this = *this + b; }
  DualOf& operator-=(const DualOf& b) { return *this = *this - b; }
  DualOf& operator*=(const DualOf& b) { return *this = *this * b; }

  friend DualOf operator-(const DualOf& a) { return {-a.v, -a.d}; }
  friend DualOf operator+(const DualOf& a, const DualOf& b) { return {a.v + b.v, a.d + b.d}; }
  friend DualOf operator-(const DualOf& a, const DualOf& b) { return {a.v - b.v, a.d - b.d}; }
  friend DualOf operator*(const DualOf& a, const DualOf& b) {
    return {a.v * b.v, a.d * b.v + b.d * a.v};
  }
  friend DualOf operator/(const DualOf& a, const DualOf& b) {
    return {a.v / b.v, (a.d - b.d * (a.v / b.v)) / b.v};
  }
  friend DualOf atan2(const DualOf& y, const DualOf& x) {
    return {std::atan2(y.v, x.v), (y.d * x.v - x.d * y.v) / (x.v * x.v + y.v * y.v)};
  }
  friend portable::SinCos<DualOf> sin_cos(const DualOf& a) {
    const auto t = portable::sin_cos(a.v);
    return {{t.sin, a.times(t.cos)}, {t.cos, a.times(-t.sin)}};
  }
  friend DualOf exp(const DualOf& a) {
    const double value = portable::exp(a.v);
    return {value, a.times(value)};
  }
  friend DualOf log(const DualOf& a) { return {portable::log(a.v), a.times(1.0 / a.v)}; }
  friend DualOf sqrt(const DualOf& a) {
    const double value = portable::sqrt(a.v);
    return {value, a.times(0.5 / value)};
  }
  friend DualOf tanh(const DualOf& a) {
    const double value = portable::tanh(a.v);
    return {value, a.times(1.0 - value * value)};
  }
  /// a^b = e^(b ln a); a power that does not change needs no logarithm.
  friend DualOf pow(const DualOf& a, const DualOf& b) {
    const double value = portable::pow(a.v, b.v);
    const double by_a = b.v == 0.0 ? 0.0 : b.v * portable::pow(a.v, b.v - 1.0);
    const double by_b = value == 0.0 ? 0.0 : value * portable::log(a.v);
    return {value, a.times(by_a) + b.times(by_b)};
  }
  friend double plain(const DualOf& a) { return a.v; }

  /// Value and slopes are finite.
  friend bool is_number(const DualOf& a) { return std::isfinite(a.v) && a.d.isFinite().all(); }
};

using Dual = DualOf<8>;

}  // namespace plumb::offline
