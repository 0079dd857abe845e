// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Compliance of gears and bearings: dq_j = c_j tau_j, where tau_j is the torque about the joint's
/// axis by everything that the joint carries (the force along it if prismatic). [Dumas 2011]
struct JointCompliance {
  static constexpr EffectParameter kParameters[] = {{"c", "rad/(N m)", 0.0, 0.0, 1e-2}};
  static constexpr EffectInfo kInfo{.name = "joint_compliance",
                                    .version = 1,
                                    .title = "joint compliance",
                                    .domain = EffectDomain::kRobot,
                                    .needs = kNeedsMasses,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<JointCompliance>(shape); }

  template <class S>
  static void apply(std::span<const S> c, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      out.dq[j] += c[i] * at.torque(j);
    }
  }
};

}  // namespace plumb::effects
