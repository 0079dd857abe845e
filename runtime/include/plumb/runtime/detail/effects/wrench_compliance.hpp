// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Compliance of joints under an external wrench W at the tool: dq_j = c_j (J^T W)_j.
struct WrenchCompliance {
  static constexpr EffectParameter kParameters[] = {{"c", "rad/(N m)", 0.0, 0.0, 1e-2}};
  static constexpr EffectInfo kInfo{.name = "wrench_compliance",
                                    .version = 1,
                                    .title = "compliance under process forces",
                                    .domain = EffectDomain::kRobot,
                                    .needs = kNeedsWrench,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<WrenchCompliance>(shape); }

  template <class S>
  static void apply(std::span<const S> c, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i)
      out.dq[shape.joints[i]] +=
          c[i] * at.loads.wrench_torque(shape.joints[i], at.chain, at.frames);
  }
};

}  // namespace plumb::effects
