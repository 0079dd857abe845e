// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Compliance of a joint under unknown weights: dq_j = sum_k s_k . w_jk with
/// w_jk,a = z_j . ((R_k e_a) x g), where s_k is c_j times the static moments of link k >= j
/// [rad s^2/m]. The rank analysis of the fit leaves out parameters that others already explain.
struct GravityFree {
  static constexpr EffectParameter kParameters[] = {{"s", "rad s^2/m", 20e-6, 0.0, 0.0}};
  static constexpr EffectInfo kInfo{.name = "gravity_free",
                                    .version = 1,
                                    .title = "joint compliance under unknown weights",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) {
    int sum = 0;
    for (int j : shape.joints) sum += 3 * (shape.arm_joints - j);
    return sum;
  }

  template <class S>
  static void apply(std::span<const S> s, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    std::size_t next = 0;
    for (int j : shape.joints) {
      const Vector3 axis = at.frames.joint[j].R.col(2);
      // z . (r x g) = r . (g x z)
      const Vector3 lever = cross<double>(at.loads.gravity, axis);
      for (int k = j; k < shape.arm_joints; ++k)
        for (int a = 0; a < 3; ++a)
          out.dq[j] += s[next++] * dot(at.frames.joint[k].R.col(a), lever);
    }
  }
};

}  // namespace plumb::effects
