// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// A balancing spring beside joint j. Its torque on the joint is proportional to
/// T(q - p) = sin(q - p) (1 - l / sqrt(1 + r^2 - 2 r cos(q - p))) at phase p, with length_ratio l
/// and anchor_ratio r, and moves the joint by s T. This depends on q_j alone, so no data can
/// distinguish it from harmonics of the same joint.
struct GravityCompensator {
  static constexpr EffectParameter kParameters[] = {{"sin", "rad", 100e-6, -5e-3, 5e-3},
                                                    {"cos", "rad", 100e-6, -5e-3, 5e-3}};
  static constexpr const char* kConstants[] = {"length_ratio", "anchor_ratio"};
  static constexpr EffectInfo kInfo{.name = "gravity_compensator",
                                    .version = 1,
                                    .title = "balancing spring",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters,
                                    .constants = kConstants};
  static int count(const EffectShape& shape) { return default_count<GravityCompensator>(shape); }

  template <class S>
  static void apply(std::span<const S> s, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    const double l = shape.constants[0], r = shape.constants[1];
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      const auto t = portable::sin_cos(at.q[j]);
      // Two springs a quarter turn apart stand for one at any phase, to first order in l r.
      const double along = 1.0 - l / portable::sqrt(1.0 + r * r - 2.0 * r * t.cos + 1e-9);
      const double across = 1.0 - l / portable::sqrt(1.0 + r * r - 2.0 * r * t.sin + 1e-9);
      out.dq[j] += s[2 * i] * (t.sin * along) + s[2 * i + 1] * (t.cos * across);
    }
  }
};

}  // namespace plumb::effects
