// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/measured_context.hpp"
#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// The tracker's stand or the floor moves: twist of the base u t + v f(t), where t runs from 0 to 1
/// over the series. f(t) = t^2, or 1 - e^(-t / T) for a stand that warms up with time constant T.
/// Belongs to the measurement: fitted, never compiled.
struct Drift {
  static constexpr EffectParameter kParameters[] = {
      {"dx1", "m", 50e-6, 0, 0},   {"dy1", "m", 50e-6, 0, 0},   {"dz1", "m", 50e-6, 0, 0},
      {"ex1", "rad", 30e-6, 0, 0}, {"ey1", "rad", 30e-6, 0, 0}, {"ez1", "rad", 30e-6, 0, 0},
      {"dx2", "m", 50e-6, 0, 0},   {"dy2", "m", 50e-6, 0, 0},   {"dz2", "m", 50e-6, 0, 0},
      {"ex2", "rad", 30e-6, 0, 0}, {"ey2", "rad", 30e-6, 0, 0}, {"ez2", "rad", 30e-6, 0, 0}};
  static constexpr const char* kConstants[] = {"from", "span",
                                               "settling"};  // of time [s], or of the order
  static constexpr EffectInfo kInfo{.name = "drift",
                                    .version = 1,
                                    .title = "drift of tracker or base",
                                    .domain = EffectDomain::kMeasurement,
                                    .needs = kNeedsTime,
                                    .per_joint = false,
                                    .repeats = false,
                                    .parameters = kParameters,
                                    .constants = kConstants};
  static int count(const EffectShape& shape) { return default_count<Drift>(shape); }

  template <class S>
  static void apply(std::span<const S> a, const EffectShape& shape, const Situation& at,
                    const offline::MeasuredContext& measured, Motion<S>& out) {
    const bool timed = at.time_s() == at.time_s();
    const double now = timed ? at.time_s() : measured.order;
    if (!(now == now)) return;
    const double t = (now - shape.constants[0]) / shape.constants[1];
    const double T = shape.constants[2] / shape.constants[1];
    const double bent = T > 0.0 ? 1.0 - portable::exp(-t / T) : t * t;
    Vec3<S> d, e;
    for (int k = 0; k < 3; ++k) {
      d(k) = a[k] * t + a[6 + k] * bent;
      e(k) = a[3 + k] * t + a[9 + k] * bent;
    }
    out.twist(Transformd{}, at.frames.tip.p, d, e);
  }
};

}  // namespace plumb::effects
