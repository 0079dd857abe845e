// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Lost motion: after a reversal a joint lags behind by h_j, once it has travelled farther than
/// about r: dq_j = -h_j d_j (1 - e^(-travel_j / r)), with direction d_j = +1 or -1, or 0 where
/// unknown. h_j is negative where the controller compensates more backlash than the joint has: it
/// then runs ahead.
struct Reversal {
  static constexpr EffectParameter kParameters[] = {{"h", "rad", 100e-6, -5e-3, 5e-3}};
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
    for (std::size_t i = 0; i < shape.joints.size(); i += 2) move_two(i, h, shape, at, out);
  }

 private:
  using Two = portable::Two;

  /// Moves joint i of the effect and the next one, if there is one.
  template <class S>
  static void move_two(std::size_t i, std::span<const S> h, const EffectShape& shape,
                       const Situation& at, Motion<S>& out) {
    const std::size_t next = i + 1 < shape.joints.size() ? i + 1 : i;
    const std::size_t j = shape.joints[i], k = shape.joints[next];
    const Two side = at.directions(j, k);
    const Two left = portable::exp_of_negative(fade(at.travels(j, k), shape.constants[0]));
    const Two behind = side * (1.0 - left);
    if (side[0] == side[0]) out.dq[j] -= h[i] * behind[0];
    if (next > i && side[1] == side[1]) out.dq[k] -= h[next] * behind[1];
  }

  /// -travel / r. An unknown travel counts as infinite, and so does any travel if r is 0.
  static Two fade(Two travel, double r) {
    constexpr double kForever = -std::numeric_limits<double>::infinity();
    const Two all_r{r, r}, none{}, forever{kForever, kForever};
    const portable::TwoBits known = (travel == travel) & (all_r > none);
    return known ? portable::below_zero(travel) / all_r : forever;
  }
};

}  // namespace plumb::effects
