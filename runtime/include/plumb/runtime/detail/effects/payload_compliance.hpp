// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Compliance of joints under the payload alone: dq_j = c_j tau_j, where tau_j is the torque of the
/// payload on the joint.
struct PayloadCompliance {
  static constexpr EffectParameter kParameters[] = {{"c", "rad/(N m)", 0.0, 0.0, 1e-2}};
  static constexpr EffectInfo kInfo{.name = "payload_compliance",
                                    .version = 1,
                                    .title = "compliance under the payload",
                                    .domain = EffectDomain::kRobot,
                                    .needs = kNeedsPayload,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<PayloadCompliance>(shape); }

  template <class S>
  static void apply(std::span<const S> c, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i)
      out.dq[shape.joints[i]] +=
          c[i] * at.loads.payload_torque(shape.joints[i], at.chain, at.frames);
  }
};

}  // namespace plumb::effects
