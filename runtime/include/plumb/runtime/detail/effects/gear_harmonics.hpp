// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Eccentricity of gears and encoder discs, once and twice per turn of the joint:
/// dq_j = sum_h s_h sin(h q_j) + c_h cos(h q_j), h = 1, 2.
struct GearHarmonics {
  static constexpr EffectParameter kParameters[] = {{"sin1", "rad", 100e-6, -5e-3, 5e-3},
                                                    {"cos1", "rad", 100e-6, -5e-3, 5e-3},
                                                    {"sin2", "rad", 100e-6, -5e-3, 5e-3},
                                                    {"cos2", "rad", 100e-6, -5e-3, 5e-3}};
  static constexpr EffectInfo kInfo{.name = "gear_harmonics",
                                    .version = 1,
                                    .title = "gear error, once and twice a joint turn",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<GearHarmonics>(shape); }

  template <class S>
  static void apply(std::span<const S> a, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      const auto one = portable::sin_cos(at.q[j]);
      const double sin2 = 2.0 * one.sin * one.cos;
      const double cos2 = one.cos * one.cos - one.sin * one.sin;
      out.dq[j] +=
          a[4 * i] * one.sin + a[4 * i + 1] * one.cos + a[4 * i + 2] * sin2 + a[4 * i + 3] * cos2;
    }
  }
};

}  // namespace plumb::effects
