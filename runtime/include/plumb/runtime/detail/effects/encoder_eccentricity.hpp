// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Eccentricity of an encoder disc by the fraction (x, y) of its radius:
/// dq_j = atan2(y', 1 + x'), where (x', y') is (x, y) turned by q_j. To first order this equals the
/// first gear harmonic, so no data can distinguish the two.
struct EncoderEccentricity {
  static constexpr EffectParameter kParameters[] = {{"x", "1", 100e-6, -1e-2, 1e-2, false},
                                                    {"y", "1", 100e-6, -1e-2, 1e-2, false}};
  static constexpr EffectInfo kInfo{.name = "encoder_eccentricity",
                                    .version = 1,
                                    .title = "encoder eccentricity",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<EncoderEccentricity>(shape); }

  template <class S>
  static void apply(std::span<const S> e, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    using portable::atan2;
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      const auto t = portable::sin_cos(at.q[j]);
      const S x = e[2 * i] * t.cos - e[2 * i + 1] * t.sin;
      const S y = e[2 * i] * t.sin + e[2 * i + 1] * t.cos;
      out.dq[j] += atan2(y, x + 1.0);
    }
  }
};

}  // namespace plumb::effects
