// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/effect.hpp"

namespace plumb::effects {

/// Teeth, wave generators, cycloids: dq_j = s sin(k q_j) + c cos(k q_j) at k cycles per joint turn,
/// k not necessarily whole.
struct GearRipple {
  static constexpr EffectParameter kParameters[] = {{"sin", "rad", 100e-6, -5e-3, 5e-3},
                                                    {"cos", "rad", 100e-6, -5e-3, 5e-3}};
  static constexpr const char* kConstants[] = {"cycles_per_turn"};
  static constexpr EffectInfo kInfo{.name = "gear_ripple",
                                    .version = 1,
                                    .title = "gear ripple",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = true,
                                    .parameters = kParameters,
                                    .constants = kConstants};
  static int count(const EffectShape& shape) { return default_count<GearRipple>(shape); }

  template <class S>
  static void apply(std::span<const S> a, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    const std::size_t count = shape.joints.size();
    if (count > 0) move(0, a, shape, at, out);
    if (count > 1) move_from_1(a, shape, at, out);
  }

 private:
  template <class S>
  static void move(std::size_t i, std::span<const S> a, const EffectShape& shape,
                   const Situation& at, Motion<S>& out) {
    const int j = shape.joints[i];
    const auto t = portable::sin_cos(shape.constants[0] * at.q[j]);
    out.dq[j] += a[2 * i] * t.sin + a[2 * i + 1] * t.cos;
  }

  /// Never inlined: what a loop needs would be made ready for one joint too, as most have.
  template <class S>
  [[gnu::noinline]] static void move_from_1(std::span<const S> a, const EffectShape& shape,
                                            const Situation& at, Motion<S>& out) {
    for (std::size_t i = 1; i < shape.joints.size(); ++i) move(i, a, shape, at, out);
  }
};

}  // namespace plumb::effects
