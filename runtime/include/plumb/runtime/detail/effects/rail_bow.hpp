// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// A rail that is not straight: what slides on it shifts sideways and turns along the travel. With
/// u = (q_j - middle_j) / half_j, about -1 to 1, and the Legendre polynomials P1, P2 and P3 the law
/// is a twist of the carriage in the axes of the joint, z along the rail:
///
///   d = (dx2 P2(u) + dx3 P3(u), dy2 P2(u) + dy3 P3(u), 0)
///   e = (ex1 P1(u) + ex2 P2(u), ey1 P1(u) + ey2 P2(u), ez1 P1(u) + ez2 P2(u))
///
/// What is missing belongs to the geometry: a constant shift or turn is where the rail stands, a
/// shift in proportion to the travel where it points.
struct RailBow {
  static constexpr EffectParameter kParameters[] = {
      {"dx2", "m", 50e-6, -5e-3, 5e-3},   {"dy2", "m", 50e-6, -5e-3, 5e-3},
      {"dx3", "m", 50e-6, -5e-3, 5e-3},   {"dy3", "m", 50e-6, -5e-3, 5e-3},
      {"ex1", "rad", 50e-6, -5e-3, 5e-3}, {"ey1", "rad", 50e-6, -5e-3, 5e-3},
      {"ez1", "rad", 50e-6, -5e-3, 5e-3}, {"ex2", "rad", 50e-6, -5e-3, 5e-3},
      {"ey2", "rad", 50e-6, -5e-3, 5e-3}, {"ez2", "rad", 50e-6, -5e-3, 5e-3}};
  static constexpr const char* kConstants[] = {"middle", "half"};
  static constexpr EffectInfo kInfo{.name = "rail_bow",
                                    .version = 1,
                                    .title = "rail that is not straight",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters,
                                    .constants = kConstants,
                                    .constants_per_joint = true};
  static int count(const EffectShape& shape) { return default_count<RailBow>(shape); }

  template <class S>
  static void apply(std::span<const S> a, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const double half = shape.constants[2 * i + 1];
      if (!(half > 0.0)) continue;
      const int j = shape.joints[i];
      const double u = (at.q[j] - shape.constants[2 * i]) / half;
      const double p2 = 1.5 * u * u - 0.5;
      const double p3 = (2.5 * u * u - 1.5) * u;
      const auto of = a.subspan(10 * i, 10);
      const Vec3<S> d(of[0] * p2 + of[2] * p3, of[1] * p2 + of[3] * p3, S(0.0));
      const Vec3<S> e(of[4] * u + of[7] * p2, of[5] * u + of[8] * p2, of[6] * u + of[9] * p2);
      out.twist(at.frames.joint[j], at.frames.tip.p, d, e);
    }
  }
};

}  // namespace plumb::effects
