// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Bending and torsion of a link, taken as a cantilever from joint j to the next. With unit vector
/// u along the link, length L, force F and moment M at its end, and its own weight q per length:
///   rotation     = f (L^2/2 u x F + L M_across + L^3/6 u x q) + t L M_along
///   displacement = f (L^3/3 F_across + L^2/2 M x u + L^4/8 q_across)
/// with f = 1/EI and t = 1/GJ. [Euler-Bernoulli; Timoshenko, Strength of Materials]
struct LinkFlexure {
  static constexpr EffectParameter kParameters[] = {{"f", "1/(N m^2)", 0.0, 0.0, 1.0},
                                                    {"t", "1/(N m^2)", 0.0, 0.0, 1.0}};
  static constexpr EffectInfo kInfo{.name = "link_flexure",
                                    .version = 1,
                                    .title = "bending of links",
                                    .domain = EffectDomain::kRobot,
                                    .needs = kNeedsMasses,
                                    .per_joint = true,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<LinkFlexure>(shape); }

  template <class S>
  static void apply(std::span<const S> theta, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      const Beam b = beam(j, shape.arm_joints, at);
      if (b.length <= 0.0) continue;
      const double L = b.length;
      const Vector3 M_along = b.u * dot(b.moment, b.u);
      const Vector3 M_across = b.moment - M_along;
      const Vector3 F_across = b.force - b.u * dot(b.force, b.u);
      const Vector3 q_across = b.weight - b.u * dot(b.weight, b.u);
      const Vector3 turn_bent = cross<double>(b.u, b.force) * (L * L / 2) + M_across * L +
                                cross<double>(b.u, b.weight) * (L * L * L / 6);
      const Vector3 turn_twisted = M_along * L;
      const Vector3 shift_bent = F_across * (L * L * L / 3) +
                                 cross<double>(b.moment, b.u) * (L * L / 2) +
                                 q_across * (L * L * L * L / 8);
      Vec3<S> d, e;
      for (int k = 0; k < 3; ++k) {
        d(k) = theta[2 * i] * shift_bent(k);
        e(k) = theta[2 * i] * turn_bent(k) + theta[2 * i + 1] * turn_twisted(k);
      }
      out.twist(b.end, at.frames.tip.p, d, e);
    }
  }

 private:
  struct Beam {
    Transformd end;  // frame at the far end, with the axes of the base
    Vector3 u, force, moment, weight;
    double length;
  };

  static Beam beam(int j, int joints, const Situation& at) {
    const bool last = j + 1 == joints;
    const Vector3 from = at.frames.joint[j].p;
    Beam out;
    out.end.p = last ? at.frames.tip.p : at.frames.joint[j + 1].p;
    const Vector3 along = out.end.p - from;
    out.length = portable::sqrt(dot(along, along));
    if (out.length < 1e-3) {
      out.length = 0.0;
      return out;
    }
    out.u = along * (1.0 / out.length);
    out.force = last ? Vector3(at.loads.payload_force) : at.loads.force(j + 1);
    out.moment =
        last ? cross<double>(Vector3(at.loads.payload_at) - out.end.p, at.loads.payload_force)
             : at.loads.moment(j + 1, at.frames);
    out.weight = (at.loads.force(j) - out.force) * (1.0 / out.length);
    return out;
  }
};

}  // namespace plumb::effects
