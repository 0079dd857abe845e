// SPDX-License-Identifier: Apache-2.0
#include "cell/link_frame.hpp"

#include <algorithm>
#include <cmath>

#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

/// The nominal arm up to and with a joint, without base and tool.
Chain arm_up_to(const format::Chain& nominal, int joint) {
  format::Chain out;
  out.convention = nominal.convention;
  out.joints.assign(nominal.joints.begin(), nominal.joints.begin() + joint + 1);
  return Chain(out);
}

/// Origin of the next joint's axis in the frame that moves with this one.
Vector3 end_of_link(const format::Chain& nominal, int joint) {
  return arm_up_to(nominal, joint + 1).constant(joint + 1).p;
}

constexpr double kOfLink = 1.0 / 3.0;
constexpr double kOfArm = 0.15;

}  // namespace

Transformd link_frame(const format::Chain& nominal, int joint) {
  return arm_up_to(nominal, joint).constant(joint + 1);
}

double distance_from_link(const format::Chain& nominal, int joint, const Vector3& point_P) {
  const Vector3 along = end_of_link(nominal, joint);
  const double squared_length = dot(along, along);
  const double share =
      squared_length > 0.0 ? std::clamp(dot(along, point_P) / squared_length, 0.0, 1.0) : 0.0;
  const Vector3 beside = point_P - along * share;
  return std::sqrt(dot(beside, beside));
}

double stretched_length(const format::Chain& nominal) {
  double out = 0.0;
  for (const auto& row : nominal.joints) out += std::abs(row.a) + std::abs(row.d);
  return out;
}

double widest_link(const format::Chain& nominal, int joint) {
  const Vector3 along = end_of_link(nominal, joint);
  return std::max(kOfLink * std::sqrt(dot(along, along)), kOfArm * stretched_length(nominal));
}

}  // namespace plumb::offline
