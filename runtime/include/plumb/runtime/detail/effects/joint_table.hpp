// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// The error of one joint as an arbitrary function of its position: dq_j is interpolated linearly
/// in a periodic table of 120 entries, 3 deg apart. Needs dense data.
struct JointTable {
  static constexpr int kEntries = 120;
  static constexpr EffectParameter kParameters[] = {{"t", "rad", 100e-6, -5e-3, 5e-3}};
  static constexpr EffectInfo kInfo{.name = "joint_table",
                                    .version = 1,
                                    .title = "table of a joint's own error",
                                    .domain = EffectDomain::kRobot,
                                    .needs = 0,
                                    .per_joint = true,
                                    .repeats = true,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) {
    return kEntries * static_cast<int>(shape.joints.size());
  }

  template <class S>
  static void apply(std::span<const S> t, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    constexpr double kTurn = 6.283185307179586;
    for (std::size_t i = 0; i < shape.joints.size(); ++i) {
      const int j = shape.joints[i];
      // 2000 turns are added so that truncation rounds downwards, also for q < 0 (|q| <= 1e4).
      const double place = (at.q[j] / kTurn + 2000.0) * kEntries;
      const auto whole = static_cast<long long>(place);
      const double share = place - static_cast<double>(whole);
      const auto first = static_cast<std::size_t>(whole % kEntries);
      const std::size_t second = first + 1 == kEntries ? 0 : first + 1;
      out.dq[j] += t[i * kEntries + first] * (1.0 - share) + t[i * kEntries + second] * share;
    }
  }
};

}  // namespace plumb::effects
