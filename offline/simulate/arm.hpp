// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::offline::sim {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The deviations of the arm from its rigid geometry at one pose.
struct Deflection {
  explicit Deflection(int joints)
      : dq(VectorXd::Zero(joints)), link(joints, Isometry3d::Identity()) {}
  VectorXd dq;                   // joint positions [rad] or [m]
  std::vector<Isometry3d> link;  // motion of everything behind joint i, in the frame P_i
  Isometry3d base = Isometry3d::Identity();  // motion of the whole arm, base frame
  Isometry3d tool = Isometry3d::Identity();  // motion of the reflector, tool frame
  Vector3d tip_B = Vector3d::Zero();         // of the measured point, base frame [m]
};

/// Frames of one pose in the base frame B; P_i is just behind the motion of joint i.
struct Frames {
  std::vector<Isometry3d> joint;  // X_BPi
  Isometry3d flange;              // X_BF
  Isometry3d tool;                // X_BT
};

/// The kinematics of the simulator, independent of those of the runtime so that one can test the
/// other. The rows are as in format::Chain: the link is Tx(a) Rx(alpha) Ry(beta), behind the joint
/// motion Rz(theta) Tz(d) in the standard convention and before it in the modified one.
class Arm {
 public:
  explicit Arm(const format::Chain& chain);

  int joints() const { return static_cast<int>(chain_.joints.size()); }
  bool slides(int i) const { return chain_.joints[i].type == format::JointType::kPrismatic; }
  const format::Chain& chain() const { return chain_; }

  Frames frames(const VectorXd& q) const { return frames(q, Deflection(joints())); }
  Frames frames(const VectorXd& q, const Deflection& deflection) const;

  /// The vector from P_i to the origin of P_(i+1), or of the flange, in P_i [m]. It depends on q
  /// only if joint i + 1 slides.
  Vector3d link_vector(int i, const VectorXd& q) const;

  /// Sum of the lengths of all links and the tool [m].
  double reach() const;

 private:
  Isometry3d motion(int i, double q) const;

  format::Chain chain_;
  Isometry3d base_, tool_;
  std::vector<Isometry3d> between_;  // [i]: from behind joint i - 1 to before joint i
};

/// Exp of a twist: displacement d [m], rotation vector e [rad].
Isometry3d exp(const Vector3d& d, const Vector3d& e);

Isometry3d to_isometry(const format::Pose& pose);
format::Pose to_pose(const Isometry3d& X);

}  // namespace plumb::offline::sim
