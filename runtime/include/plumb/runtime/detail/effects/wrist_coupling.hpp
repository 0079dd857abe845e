// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Coupling of wrist joints whose gear trains pass through each other. With n the last joint:
/// dq_(n-1) = k45 q_(n-2), dq_n = k46 q_(n-2) + k56 q_(n-1).
struct WristCoupling {
  static constexpr EffectParameter kParameters[] = {{"k45", "1", 100e-6, -0.1, 0.1},
                                                    {"k46", "1", 100e-6, -0.1, 0.1},
                                                    {"k56", "1", 100e-6, -0.1, 0.1}};
  static constexpr EffectInfo kInfo{.name = "wrist_coupling",
                                    .version = 1,
                                    .title = "coupling of the wrist joints",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = false,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<WristCoupling>(shape); }

  template <class S>
  static void apply(std::span<const S> k, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    const int n = shape.arm_joints;
    if (n < 3) return;
    out.dq[n - 2] += k[0] * at.q[n - 3];
    out.dq[n - 1] += k[1] * at.q[n - 3] + k[2] * at.q[n - 2];
  }
};

}  // namespace plumb::effects
