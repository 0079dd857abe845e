// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Thermal expansion of links: with dT the temperature above the reference, the vector from joint j
/// to the next grows by the fraction a_j dT, and the column leans by (lean_x, lean_y) dT about the
/// base's origin.
struct ThermalGrowth {
  static constexpr EffectParameter kParameters[] = {{"a", "1/K", 15e-6, -1e-3, 1e-3}};
  static constexpr const char* kConstants[] = {"reference_degC"};
  static constexpr EffectInfo kInfo{.name = "thermal_growth",
                                    .version = 1,
                                    .title = "thermal growth",
                                    .domain = EffectDomain::kEnvironment,
                                    .needs = kNeedsTemperature,
                                    .per_joint = true,
                                    .repeats = true,
                                    .parameters = kParameters,
                                    .constants = kConstants};
  static int count(const EffectShape& shape) {
    return static_cast<int>(shape.joints.size()) + 2;  // the links, then lean_x, lean_y [rad/K]
  }

  template <class S>
  static void apply(std::span<const S> a, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    const double temperature_degC = at.temperature_degC(shape, 0);
    if (!(temperature_degC == temperature_degC)) return;
    const double warm = temperature_degC - shape.constants[0];
    const std::size_t links = shape.joints.size();
    for (std::size_t i = 0; i < links; ++i) {
      const int j = shape.joints[i];
      const Vector3 end = j + 1 == shape.arm_joints ? at.frames.tip.p : at.frames.joint[j + 1].p;
      const Vector3 longer = (end - at.frames.joint[j].p) * warm;
      for (int k = 0; k < 3; ++k) out.shift_B(k) += a[i] * longer(k);
    }
    out.twist(Transformd{}, at.frames.tip.p, Vec3<S>(S(0.0), S(0.0), S(0.0)),
              Vec3<S>(a[links] * warm, a[links + 1] * warm, S(0.0)));
  }
};

}  // namespace plumb::effects
