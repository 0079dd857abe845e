// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "simulate/arm.hpp"
#include "simulate/random.hpp"

namespace plumb::offline::sim {

/// Masses of the moving links. What the cell does not state is guessed from its size: the arm
/// carries 5 r^3 kg at reach r [m] (1.3 m: 11 kg, 2.2 m: 53 kg) or its payload if that is more, and
/// weighs 3 / m of payload times reach; each link weighs 0.6 of the one before it, its centre of
/// mass lies near the middle of the link and a little beside it.
struct MassModel {
  std::vector<double> mass;                 // [kg]
  std::vector<Vector3d> com;                // in P_i [m]
  double payload = 0.0;                     // [kg]
  Vector3d payload_com = Vector3d::Zero();  // flange frame [m]
  Vector3d gravity;                         // base frame [m/s^2]
};

/// What the cell states is off by `share` (1 sigma), a centre of mass by share times 0.1 m.
MassModel guess_masses(const Cell& cell, const Arm& arm, double share, Random random);

/// Weight of everything behind a joint, at one pose, base frame.
class Loads {
 public:
  Loads(const MassModel& masses, const Frames& frames)
      : Loads(masses, frames, masses.payload, masses.payload_com) {}
  Loads(const MassModel& masses, const Frames& frames, double payload_kg, const Vector3d& com_F);

  /// Weight of links j .. end and the payload [N]; j = joints: the payload alone.
  Vector3d force(int j) const { return mass_[j] * gravity_; }
  /// Its moment about point o_B [N m].
  Vector3d moment(int j, const Vector3d& o_B) const {
    return (first_moment_[j] - mass_[j] * o_B).cross(gravity_);
  }
  /// Gravity torque on revolute joint j about its own axis [N m].
  double torque(int j) const { return axis_[j].dot(moment(j, origin_[j])); }
  /// The payload's share of it.
  double payload_torque(int j) const {
    return axis_[j].dot(moment(static_cast<int>(axis_.size()), origin_[j]));
  }

 private:
  std::vector<double> mass_;            // [kg], links j .. end and payload
  std::vector<Vector3d> first_moment_;  // [kg m]
  std::vector<Vector3d> axis_, origin_;
  Vector3d gravity_;
};

}  // namespace plumb::offline::sim
