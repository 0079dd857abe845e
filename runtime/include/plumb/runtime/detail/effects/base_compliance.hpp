// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Compliance of the foundation: the base turns by K M, where M is the moment of all loads about
/// its origin. K is a full symmetric matrix, because a foundation is rarely softest along the axes
/// of the base.
struct BaseCompliance {
  static constexpr EffectParameter kParameters[] = {
      {"kxx", "rad/(N m)", 0.0, 0.0, 1e-3},   {"kyy", "rad/(N m)", 0.0, 0.0, 1e-3},
      {"kzz", "rad/(N m)", 0.0, 0.0, 1e-3},   {"kxy", "rad/(N m)", 0.0, -1e-3, 1e-3},
      {"kxz", "rad/(N m)", 0.0, -1e-3, 1e-3}, {"kyz", "rad/(N m)", 0.0, -1e-3, 1e-3}};
  static constexpr EffectInfo kInfo{.name = "base_compliance",
                                    .version = 1,
                                    .title = "compliance of the base",
                                    .domain = EffectDomain::kRobot,
                                    .needs = kNeedsMasses,
                                    .per_joint = false,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<BaseCompliance>(shape); }

  template <class S>
  static void apply(std::span<const S> k, const EffectShape&, const Situation& at, Motion<S>& out) {
    const Vector3 moment = at.loads.base_moment(at.frames);
    out.rotate(Vec3<S>(k[0] * moment(0) + k[3] * moment(1) + k[4] * moment(2),
                       k[3] * moment(0) + k[1] * moment(1) + k[5] * moment(2),
                       k[4] * moment(0) + k[5] * moment(1) + k[2] * moment(2)),
               at.frames.tip.p);
  }
};

}  // namespace plumb::effects
