// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/measured_context.hpp"
#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Joints read before the arm stood still: dq_j = T_j u_j, u_j the joint's last move as a share of
/// the largest move of all joints. Belongs to the procedure: fitted, never compiled.
struct SettlingLag {
  static constexpr EffectParameter kParameters[] = {{"T", "rad", 100e-6, -5e-3, 5e-3}};
  static constexpr EffectInfo kInfo{.name = "settling_lag",
                                    .version = 1,
                                    .title = "readings before standstill",
                                    .domain = EffectDomain::kProcedure,
                                    .needs = kNeedsSteps,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<SettlingLag>(shape); }

  template <class S>
  static void apply(std::span<const S> T, const EffectShape& shape, const Situation&,
                    const offline::MeasuredContext& measured, Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const double step = measured.step[shape.joints[i]];
      if (step == step) out.dq[shape.joints[i]] += T[i] * step;
    }
  }
};

}  // namespace plumb::effects
