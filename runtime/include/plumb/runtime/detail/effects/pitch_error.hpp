// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// A screw, rack, belt or linear encoder that errs with its pitch p, once and twice a pitch:
/// dq_j = sum_h s_h sin(2 pi h q_j / p) + c_h cos(2 pi h q_j / p), h = 1, 2. Nothing where p is 0.
struct PitchError {
  static constexpr EffectParameter kParameters[] = {{"sin1", "m", 10e-6, -5e-3, 5e-3},
                                                    {"cos1", "m", 10e-6, -5e-3, 5e-3},
                                                    {"sin2", "m", 10e-6, -5e-3, 5e-3},
                                                    {"cos2", "m", 10e-6, -5e-3, 5e-3}};
  static constexpr const char* kConstants[] = {"pitch"};
  static constexpr EffectInfo kInfo{.name = "pitch_error",
                                    .version = 1,
                                    .title = "periodic error of a pitch",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = true,
                                    .parameters = kParameters,
                                    .constants = kConstants};
  static int count(const EffectShape& shape) { return default_count<PitchError>(shape); }

  template <class S>
  static void apply(std::span<const S> a, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    const double pitch = shape.constants[0];
    if (!(pitch > 0.0)) return;
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      const auto one = portable::sin_cos(2.0 * std::numbers::pi / pitch * at.q[j]);
      const double sin2 = 2.0 * one.sin * one.cos;
      const double cos2 = one.cos * one.cos - one.sin * one.sin;
      out.dq[j] +=
          a[4 * i] * one.sin + a[4 * i + 1] * one.cos + a[4 * i + 2] * sin2 + a[4 * i + 3] * cos2;
    }
  }
};

}  // namespace plumb::effects
