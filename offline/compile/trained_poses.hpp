// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "cell/random.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// Poses that are looked at before a model moves a robot.
inline constexpr int kAuditPoses = 2000;

/// The smallest and the largest position of each joint [rad or m].
using JointRanges = std::vector<std::pair<double, double>>;

inline std::vector<double> somewhere_in(const JointRanges& box, Random& random) {
  std::vector<double> out;
  for (const auto& [low, high] : box) out.push_back(low + random.unit() * (high - low));
  return out;
}

/// Where a model was trained; the joint limits of what it does not say.
inline JointRanges trained_box(const format::Model& model) {
  JointRanges out;
  for (std::size_t i = 0; i < model.nominal.joints.size(); ++i) {
    const auto& row = model.nominal.joints[i];
    const bool trained = i < model.domain.q_min.size();
    out.emplace_back(trained ? model.domain.q_min[i] : row.q_min,
                     trained ? model.domain.q_max[i] : row.q_max);
  }
  return out;
}

}  // namespace plumb::offline
