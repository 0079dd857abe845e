// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// The error of one joint as a series of whole waves of its turn:
///
///   dq_j = sum_k s_k sin(k q_j) + c_k cos(k q_j),  k = 1 ... waves
///
/// The same a whole turn further. `size` [rad] and `slope` do not move the arm: they state the
/// prior that the numbers were fitted with, a standard deviation of size k^-slope.
///
/// Summed by Clenshaw's recurrence from one sine and cosine of q: both sums side by side in one
/// SIMD register, four instructions a wave. Error: below 1e-12 of the sum of all |s_k| and |c_k|,
/// for 64 waves and any |q| <= 1e4 of which sine and cosine are exact to the last place.
struct JointSeries {
  static constexpr EffectParameter kParameters[] = {{"sin", "rad", 100e-6, -5e-3, 5e-3},
                                                    {"cos", "rad", 100e-6, -5e-3, 5e-3}};
  static constexpr const char* kConstants[] = {"waves", "size", "slope"};
  static constexpr EffectInfo kInfo{.name = "joint_series",
                                    .version = 1,
                                    .title = "series of a joint's own error",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = true,
                                    .parameters = kParameters,
                                    .constants = kConstants};

  /// Number of waves of a joint; 0 if the constant is none.
  static int waves(const EffectShape& shape) {
    const double stated = shape.constants.empty() ? 0.0 : shape.constants[0];
    if (!(stated >= 1.0 && stated <= static_cast<double>(format::kMaxSeriesWaves))) return 0;
    const int whole = static_cast<int>(stated);
    return static_cast<double>(whole) == stated ? whole : 0;
  }

  /// -1 for a number of waves that is none: no effect has so many parameters.
  static int count(const EffectShape& shape) {
    const int each = waves(shape);
    return each > 0 ? 2 * each * static_cast<int>(shape.joints.size()) : -1;
  }

  template <class S>
  static void apply(std::span<const S> a, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    const auto each = 2 * static_cast<std::size_t>(waves(shape));
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      out.dq[j] += sum(a.subspan(i * each, each), portable::sin_cos(at.q[j]));
    }
  }

  /// How the sum changes with each of its numbers, at an angle of this sine and cosine:
  /// sin(q), cos(q), sin(2 q), cos(2 q), ...
  static void slopes(const portable::SinCos<double>& one, std::span<double> out) {
    portable::SinCos<double> wave = one;
    for (std::size_t k = 0; k + 1 < out.size(); k += 2) {
      out[k] = wave.sin;
      out[k + 1] = wave.cos;
      wave = {wave.sin * one.cos + wave.cos * one.sin, wave.cos * one.cos - wave.sin * one.sin};
    }
  }

 private:
  /// b_k = a_k + 2 cos(q) b_k+1 - b_k+2; the sines add up to b_1 sin(q), the cosines to
  /// b_1 cos(q) - b_2. [Clenshaw 1955]
  template <class S>
  static S sum(std::span<const S> a, const portable::SinCos<double>& one) {
    if constexpr (std::is_same_v<S, double>) {
      return sum_of_two(a, one);
    } else {
      const S twice(2.0 * one.cos);
      S sin1(0.0), sin2(0.0), cos1(0.0), cos2(0.0);
      for (std::size_t k = a.size(); k >= 2; k -= 2) {
        const S sin0 = a[k - 2] - sin2 + twice * sin1, cos0 = a[k - 1] - cos2 + twice * cos1;
        sin2 = sin1, sin1 = sin0;
        cos2 = cos1, cos1 = cos0;
      }
      return sin1 * S(one.sin) + (cos1 * S(one.cos) - cos2);
    }
  }

  static double sum_of_two(std::span<const double> a, const portable::SinCos<double>& one) {
    using portable::Two;
    const double* at = a.data() + a.size();
    const Two twice{2.0 * one.cos, 2.0 * one.cos};
    Two b1{}, b2{};  // sines first
    if (a.size() % 4 != 0) {
      at -= 2;
      b1 = load(at);
    }
    while (at != a.data()) {  // two waves a turn, so that nothing is moved between registers
      at -= 4;
      b2 = load(at + 2) - b2 + twice * b1;
      b1 = load(at) - b1 + twice * b2;
    }
    return b1[0] * one.sin + (b1[1] * one.cos - b2[1]);
  }

  static portable::Two load(const double* two) {
    portable::Two out;
    __builtin_memcpy(&out, two, sizeof out);
    return out;
  }
};

}  // namespace plumb::effects
