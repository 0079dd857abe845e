// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Cross compliance through a common housing: the torque of joint j turns joint i, dq_i = c tau_j.
/// The effect's list of joints is (i, j).
struct CrossCompliance {
  static constexpr EffectParameter kParameters[] = {{"c", "rad/(N m)", 0.0, -1e-2, 1e-2}};
  static constexpr EffectInfo kInfo{.name = "cross_compliance",
                                    .version = 1,
                                    .title = "cross compliance",
                                    .domain = EffectDomain::kRobot,
                                    .needs = kNeedsMasses,
                                    .per_joint = false,
                                    .repeats = true,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<CrossCompliance>(shape); }

  template <class S>
  static void apply(std::span<const S> c, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    if (shape.joints.size() < 2) return;
    out.dq[shape.joints[0]] += c[0] * at.torque(shape.joints[1]);
  }
};

}  // namespace plumb::effects
