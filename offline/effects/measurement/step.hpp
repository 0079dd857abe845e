// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/measured_context.hpp"
#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Something moved once. All later rows have a shift of the tool (of = 0: a bumped reflector), a
/// twist of the base (1: a bumped tracker or base) or an offset of a joint (2: a slipped encoder;
/// `joints` holds that joint). Constant `row`: number (from 1) of the last row before it, minus
/// 0.5.
struct Step {
  static constexpr EffectParameter kParameters[] = {
      {"dx", "m", 300e-6, 0, 0},   {"dy", "m", 300e-6, 0, 0},   {"dz", "m", 300e-6, 0, 0},
      {"ex", "rad", 300e-6, 0, 0}, {"ey", "rad", 300e-6, 0, 0}, {"ez", "rad", 300e-6, 0, 0}};
  static constexpr const char* kConstants[] = {"row", "of"};
  static constexpr EffectInfo kInfo{.name = "step",
                                    .version = 1,
                                    .title = "something moved",
                                    .domain = EffectDomain::kMeasurement,
                                    .needs = kNeedsOrder,
                                    .per_joint = false,
                                    .repeats = true,
                                    .parameters = kParameters,
                                    .constants = kConstants};
  enum Of { kTool = 0, kBase = 1, kJoint = 2 };
  static int of(const EffectShape& shape) {
    const double code = shape.constants[1];
    return code < 0.5 ? kTool : code < 1.5 ? kBase : kJoint;
  }
  /// Tool: the shift. Base: shift and turn. Joint: one offset.
  static int count(const EffectShape& shape) {
    return of(shape) == kTool ? 3 : of(shape) == kBase ? 6 : 1;
  }

  template <class S>
  static void apply(std::span<const S> a, const EffectShape& shape, const Situation& at,
                    const offline::MeasuredContext& measured, Motion<S>& out) {
    if (!(measured.order > shape.constants[0])) return;
    const Vec3<S> none(S(0.0), S(0.0), S(0.0));
    switch (of(shape)) {
      case kTool:
        out.twist(at.frames.tip, at.frames.tip.p, Vec3<S>(a[0], a[1], a[2]), none);
        break;
      case kBase:
        out.twist(Transformd{}, at.frames.tip.p, Vec3<S>(a[0], a[1], a[2]),
                  Vec3<S>(a[3], a[4], a[5]));
        break;
      default:
        if (!shape.joints.empty()) out.dq[shape.joints[0]] += a[0];
    }
  }
};

}  // namespace plumb::effects
