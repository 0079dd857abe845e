// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "plumb/format/model.hpp"
#include "urdf/dh_conversion.hpp"

namespace plumb::offline {

/// A joint without a value of its own (URDF: mimic): it moves by `ratio` times the value of
/// another.
struct Follower {
  std::size_t joint = 0, leader = 0;  // among all joints that move
  double ratio = 1.0;
};

/// The joints that have a value of their own. Whatever moves about the axis of such a joint
/// directly beside it, or slides along it, adds to its motion, in any order.
struct OwnJoints {
  std::vector<JointAxis> axes;  // limits are those of the sum, before `scale`
  std::vector<double> scale;    // of a joint that is followed by one on its own axis
  std::vector<format::JointCoupling> coupling;
  std::vector<std::size_t> own;            // of every joint: in `axes`
  std::vector<const Follower*> left_over;  // no joint on its axis, or of another kind
};
OwnJoints without_followers(const std::vector<JointAxis>& joints,
                            const std::vector<Follower>& followers);

}  // namespace plumb::offline
