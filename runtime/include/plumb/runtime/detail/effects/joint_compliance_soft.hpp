// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Compliance of a joint that is soft at small torques and stiffer at large ones:
/// dq_j = c_j tau_j + d_j (1 - e^(-|tau_j| / t)) sgn(tau_j).
struct JointComplianceSoft {
  static constexpr EffectParameter kParameters[] = {{"c", "rad/(N m)", 0.0, 0.0, 1e-2},
                                                    {"d", "rad", 150e-6, 0.0, 5e-3}};
  static constexpr const char* kConstants[] = {"torque_Nm"};  // t, per joint
  static constexpr EffectInfo kInfo{.name = "joint_compliance_soft",
                                    .version = 1,
                                    .title = "progressive joint compliance",
                                    .domain = EffectDomain::kRobot,
                                    .needs = kNeedsMasses,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters,
                                    .constants = kConstants,
                                    .constants_per_joint = true};
  static int count(const EffectShape& shape) { return default_count<JointComplianceSoft>(shape); }

  template <class S>
  static void apply(std::span<const S> theta, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      const double torque = at.torque(j);
      const double size = torque < 0.0 ? -torque : torque;
      const double given = 1.0 - portable::exp(-size / shape.constants[i]);
      out.dq[j] += theta[2 * i] * torque + theta[2 * i + 1] * (torque < 0.0 ? -given : given);
    }
  }
};

}  // namespace plumb::effects
