// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Sag of a tool or gripper at a compliant flange: in the axes of the tool its tip is displaced by
/// C (R^T g) m, where m is the payload. C is a full matrix, because a weight that is not in line
/// with the flange also tilts it.
struct ToolSag {
  static constexpr EffectParameter kParameters[] = {
      {"cxx", "m/N", 0.0, 0.0, 1e-3},   {"cxy", "m/N", 0.0, -1e-3, 1e-3},
      {"cxz", "m/N", 0.0, -1e-3, 1e-3}, {"cyx", "m/N", 0.0, -1e-3, 1e-3},
      {"cyy", "m/N", 0.0, 0.0, 1e-3},   {"cyz", "m/N", 0.0, -1e-3, 1e-3},
      {"czx", "m/N", 0.0, -1e-3, 1e-3}, {"czy", "m/N", 0.0, -1e-3, 1e-3},
      {"czz", "m/N", 0.0, 0.0, 1e-3}};
  static constexpr EffectInfo kInfo{.name = "tool_sag",
                                    .version = 1,
                                    .title = "sag of the tool",
                                    .domain = EffectDomain::kRobot,
                                    .needs = kNeedsPayload,
                                    .per_joint = false,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<ToolSag>(shape); }

  template <class S>
  static void apply(std::span<const S> c, const EffectShape&, const Situation& at, Motion<S>& out) {
    const Vector3 pull = at.loads.payload_force_in(at.frames.tip);
    out.displace(at.frames.tip.R, Vec3<S>(c[0] * pull(0) + c[1] * pull(1) + c[2] * pull(2),
                                          c[3] * pull(0) + c[4] * pull(1) + c[5] * pull(2),
                                          c[6] * pull(0) + c[7] * pull(1) + c[8] * pull(2)));
  }
};

}  // namespace plumb::effects
