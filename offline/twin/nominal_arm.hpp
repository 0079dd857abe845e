// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/arm.hpp"

namespace plumb::offline::twin {

using sim::Isometry3d;
using sim::Vector3d;
using sim::VectorXd;

/// The arm as the robot controller knows it: its nominal kinematics, forward and inverse. It is
/// independent of the runtime, with the frames of the simulator and a numerical inverse.
class NominalArm {
 public:
  explicit NominalArm(const format::Chain& chain) : arm_(chain), reach_m_(arm_.reach()) {}

  int joints() const { return arm_.joints(); }
  const format::Chain& chain() const { return arm_.chain(); }

  /// Tool pose in the base frame, X_BT.
  Isometry3d forward(const VectorXd& q) const { return arm_.frames(q).tool; }

  /// Moves q [rad, m] to the joint positions with the tool at X_BT, in the configuration of q.
  /// Returns false, with q unchanged, if it does not come within 1 nm and 1 nrad of the pose or if
  /// the solution is more than 0.5 rad away. An arm with fewer than six joints must be able to
  /// reach the target.
  bool inverse(const Isometry3d& X_BT, VectorXd& q) const;

  /// Smallest singular value of the Jacobian, lengths divided by the reach.
  double dexterity(const VectorXd& q) const;

  /// Sign of the determinant of a six-axis arm's Jacobian; 0 for other arms. It changes only
  /// through a singular pose.
  int configuration(const VectorXd& q) const;

 private:
  Eigen::MatrixXd jacobian(const VectorXd& q) const;  // (6, n), lengths divided by the reach

  sim::Arm arm_;
  double reach_m_;
};

}  // namespace plumb::offline::twin
