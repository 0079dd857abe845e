// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Ripple of a gear (teeth, wave generator, cycloidal disc): dq_j = s sin(k q_j) + c cos(k q_j)
/// with k cycles per turn of the joint, not necessarily a whole number.
struct GearRipple {
  static constexpr EffectParameter kParameters[] = {{"sin", "rad", 100e-6, -5e-3, 5e-3},
                                                    {"cos", "rad", 100e-6, -5e-3, 5e-3}};
  static constexpr const char* kConstants[] = {"cycles_per_turn"};
  static constexpr EffectInfo kInfo{.name = "gear_ripple",
                                    .version = 1,
                                    .title = "gear ripple",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = true,
                                    .parameters = kParameters,
                                    .constants = kConstants};
  static int count(const EffectShape& shape) { return default_count<GearRipple>(shape); }

  template <class S>
  static void apply(std::span<const S> a, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      const auto t = portable::sin_cos(shape.constants[0] * at.q[j]);
      out.dq[j] += a[2 * i] * t.sin + a[2 * i + 1] * t.cos;
    }
  }
};

}  // namespace plumb::effects
