// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/format/model.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {

/// A moving joint at its zero position, in the root frame.
struct JointAxis {
  std::string name;
  format::JointType type = format::JointType::kRevolute;
  Vector3 point = Vector3::Zero();       // on the axis [m]
  Vector3 direction = Vector3::UnitZ();  // unit length
  double q_min = 0.0, q_max = 0.0;
};

struct DhArm {
  format::Chain chain;  // its forward kinematics equal those of the axes to rounding
  /// The frame behind each joint at zero position, in the root frame. Link masses are stated in it.
  std::vector<Transformd> behind_joint;
};

/// DH rows of an arm given by its axes and by the pose X_RT of the tip at zero. Frames lie on the
/// common normals. Where neighbouring axes are parallel to within 0.01 rad their common normal may
/// be far away; there Hayati's beta is used instead [Hayati 1983]. What DH rows cannot express at
/// the two ends of the arm goes to base and tool.
DhArm to_dh(const std::vector<JointAxis>& axes, const Transformd& X_RT,
            format::Convention convention);

}  // namespace plumb::offline
