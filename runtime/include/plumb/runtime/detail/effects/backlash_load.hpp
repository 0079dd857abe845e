// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Backlash of a gear whose teeth the load presses to one flank: dq_j = (b_j / 2) tanh(tau_j / t),
/// where tau_j is the torque on the joint.
struct BacklashLoad {
  static constexpr EffectParameter kParameters[] = {{"b", "rad", 150e-6, 0.0, 5e-3}};
  static constexpr const char* kConstants[] = {"torque_Nm"};  // t, per joint
  static constexpr EffectInfo kInfo{.name = "backlash_load",
                                    .version = 1,
                                    .title = "backlash under load",
                                    .domain = EffectDomain::kRobot,
                                    .needs = kNeedsMasses,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters,
                                    .constants = kConstants,
                                    .constants_per_joint = true};
  static int count(const EffectShape& shape) { return default_count<BacklashLoad>(shape); }

  template <class S>
  static void apply(std::span<const S> b, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      out.dq[j] += b[i] * (0.5 * portable::tanh(at.torque(j) / shape.constants[i]));
    }
  }
};

}  // namespace plumb::effects
