// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Coupled drives: joint i moves by a share of the position of joint j, dq_i = c q_j. A gear train,
/// a parallelogram or a ball screw passes through the other joint, and what the controller takes
/// out for that is a little wrong. The effect's list of joints is (i, j).
struct DriveCoupling {
  static constexpr EffectParameter kParameters[] = {{"c", "1", 100e-6, -1.5, 1.5}};
  static constexpr EffectInfo kInfo{.name = "drive_coupling",
                                    .version = 1,
                                    .title = "coupled drives",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = false,
                                    .repeats = true,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<DriveCoupling>(shape); }

  template <class S>
  static void apply(std::span<const S> c, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    if (shape.joints.size() < 2) return;
    out.dq[shape.joints[0]] += c[0] * at.q[shape.joints[1]];
  }
};

}  // namespace plumb::effects
