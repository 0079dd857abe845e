// SPDX-License-Identifier: Apache-2.0
#pragma once

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
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      const double direction = at.context.direction[j];
      if (!(direction == direction)) continue;
      const double travel = at.context.travel[j];
      double grown = 1.0;
      if (travel == travel && shape.constants[0] > 0.0)
        grown = 1.0 - portable::exp(-(travel < 0.0 ? -travel : travel) / shape.constants[0]);
      out.dq[j] -= h[i] * (direction * grown);
    }
  }
};

}  // namespace plumb::effects
