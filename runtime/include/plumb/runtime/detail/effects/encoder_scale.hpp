// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// A wrong gear ratio or encoder constant: dq_j = s_j q_j.
struct EncoderScale {
  static constexpr EffectParameter kParameters[] = {{"s", "1", 30e-6, -1e-2, 1e-2}};
  static constexpr EffectInfo kInfo{.name = "encoder_scale",
                                    .version = 1,
                                    .title = "encoder scale",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<EncoderScale>(shape); }

  template <class S>
  static void apply(std::span<const S> s, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i)
      out.dq[shape.joints[i]] += s[i] * at.q[shape.joints[i]];
  }
};

}  // namespace plumb::effects
