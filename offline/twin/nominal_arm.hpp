// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/arm.hpp"

namespace plumb::offline::twin {

using sim::Isometry3d;
using sim::Vector3d;
using sim::VectorXd;

/// The arm as the robot controller knows it: nominal kinematics, there and back. Written apart from
/// the runtime's: the simulator's frames, and a numerical inverse.
class NominalArm {
 public:
  explicit NominalArm(const format::Chain& chain) : arm_(chain), reach_m_(arm_.reach()) {}

  int joints() const { return arm_.joints(); }
  const format::Chain& chain() const { return arm_.chain(); }

  /// Tool pose in the base frame, X_BT.
  Isometry3d forward(const VectorXd& q) const { return arm_.frames(q).tool; }

  /// Moves q [rad, m] to where the tool stands at X_BT, in the configuration that q is in. False,
  /// and q as it was, if it does not get within 1 nm and 1 nrad, or only beyond 0.5 rad away.
  /// Fewer than six joints: the target must be one that the arm can reach.
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
