// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Run-out of a bearing: the axis of joint j tilts and shifts sideways once and twice per turn. The
/// law is a twist before the joint with components (dx, dy, ex, ey), each the sum over h = 1, 2 of
/// s_h sin(h q_j) + c_h cos(h q_j).
struct AxisWobble {
  static constexpr EffectParameter kParameters[] = {
      {"dx_sin1", "m", 10e-6, -1e-3, 1e-3},   {"dx_cos1", "m", 10e-6, -1e-3, 1e-3},
      {"dy_sin1", "m", 10e-6, -1e-3, 1e-3},   {"dy_cos1", "m", 10e-6, -1e-3, 1e-3},
      {"ex_sin1", "rad", 30e-6, -1e-3, 1e-3}, {"ex_cos1", "rad", 30e-6, -1e-3, 1e-3},
      {"ey_sin1", "rad", 30e-6, -1e-3, 1e-3}, {"ey_cos1", "rad", 30e-6, -1e-3, 1e-3},
      {"dx_sin2", "m", 10e-6, -1e-3, 1e-3},   {"dx_cos2", "m", 10e-6, -1e-3, 1e-3},
      {"dy_sin2", "m", 10e-6, -1e-3, 1e-3},   {"dy_cos2", "m", 10e-6, -1e-3, 1e-3},
      {"ex_sin2", "rad", 30e-6, -1e-3, 1e-3}, {"ex_cos2", "rad", 30e-6, -1e-3, 1e-3},
      {"ey_sin2", "rad", 30e-6, -1e-3, 1e-3}, {"ey_cos2", "rad", 30e-6, -1e-3, 1e-3}};
  static constexpr EffectInfo kInfo{.name = "axis_wobble",
                                    .version = 1,
                                    .title = "wobble of an axis",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<AxisWobble>(shape); }

  template <class S>
  static void apply(std::span<const S> a, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      const auto one = portable::sin_cos(at.q[j]);
      const double wave[4] = {one.sin, one.cos, 2.0 * one.sin * one.cos,
                              one.cos * one.cos - one.sin * one.sin};
      S sum[4];
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t first = 16 * i + 2 * k;
        sum[k] = a[first] * wave[0] + a[first + 1] * wave[1] + a[first + 8] * wave[2] +
                 a[first + 9] * wave[3];
      }
      // The axes of the twist do not turn with the joint.
      const Transformd& P = at.frames.joint[j];
      Transformd pre = P;
      pre.R.col(0) = P.R.col(0) * one.cos - P.R.col(1) * one.sin;
      pre.R.col(1) = P.R.col(0) * one.sin + P.R.col(1) * one.cos;
      out.twist(pre, at.frames.tip.p, Vec3<S>(sum[0], sum[1], S(0.0)),
                Vec3<S>(sum[2], sum[3], S(0.0)));
    }
  }
};

}  // namespace plumb::effects
