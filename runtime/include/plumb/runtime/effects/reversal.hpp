// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "plumb/runtime/effect.hpp"

namespace plumb::effects {

/// Lost motion: a joint stays behind by h_j on the side it came from, once it has travelled farther
/// than about r: dq_j = -h_j d_j (1 - e^(-travel_j / r)), d_j = +1, -1, or 0 = unknown.
struct Reversal {
  static constexpr EffectParameter kParameters[] = {{"h", "rad", 100e-6, 0.0, 5e-3}};
  static constexpr const char* kConstants[] = {"transition_rad"};
  static constexpr EffectInfo kInfo{.name = "reversal",
                                    .version = 1,
                                    .title = "reversal error",
                                    .domain = EffectDomain::kRobot,
                                    .needs = kNeedsDirection,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters,
                                    .constants = kConstants};
  static int count(const EffectShape& shape) { return default_count<Reversal>(shape); }

  template <class S>
  static void apply(std::span<const S> h, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    const std::size_t count = shape.joints.size();
    const double r = shape.constants[0];
    for (std::size_t i = 0; i < count; i += 2) {
      const std::size_t next = i + 1 < count ? i + 1 : i;
      const auto left = portable::exp_of_negative(
          std::array{fade(at.travel(shape.joints[i]), r), fade(at.travel(shape.joints[next]), r)});
      move(i, 1.0 - left[0], h, shape, at, out);
      if (next > i) move(next, 1.0 - left[1], h, shape, at, out);
    }
  }

 private:
  /// -travel / r; where the travel is unknown, as after a long one.
  static double fade(double travel, double r) {
    if (!(travel == travel && r > 0.0)) return -std::numeric_limits<double>::infinity();
    return -__builtin_fabs(travel) / r;
  }

  template <class S>
  static void move(std::size_t i, double grown, std::span<const S> h, const EffectShape& shape,
                   const Situation& at, Motion<S>& out) {
    const std::size_t j = shape.joints[i];
    const double direction = at.direction(j);
    if (direction == direction) out.dq[j] -= h[i] * (direction * grown);
  }
};

}  // namespace plumb::effects
