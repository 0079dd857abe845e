// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/random.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {

/// Where poses may lie. SI.
struct PoseRules {
  struct Box {
    std::array<double, 3> low{}, high{};  // of the reflector, base frame [m]
  };
  std::vector<Box> boxes = {};  // inside any of them; empty: everywhere
  double joint_share = 1.0;     // of each joint's range, around its middle
  int pool = 5000;
  std::uint64_t seed = 1;
};

/// Random poses within the joint limits whose reflector lies in a box, shape (up to pool, joints).
/// Fewer than asked for if hardly any pose fits; throws Failure (kNumbersSayNo, E-PLAN-BOX) if none
/// of 200 times the pool does.
RowsN pose_pool(const Cell& cell, const ArmState& state, const PoseRules& rules);

/// Pose q with one or two joints elsewhere in their range, as often at its ends as within; q itself
/// if that is nowhere in a box.
Eigen::VectorXd pose_beside(const Cell& cell, const ArmState& state, const PoseRules& rules,
                            const Eigen::VectorXd& q, Random& random);

/// The reflector in the base frame at joint positions q.
Vector3 reflector_B(const ArmState& state, const Eigen::VectorXd& q);

}  // namespace plumb::offline
