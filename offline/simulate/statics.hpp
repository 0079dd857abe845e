// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "simulate/arm.hpp"
#include "simulate/drives.hpp"
#include "simulate/random.hpp"

namespace plumb::offline::sim {

/// The masses of the moving links. Masses that the cell does not state are estimated from the size
/// of the arm. It carries 5 r^3 kg at reach r [m] (11 kg at 1.3 m, 53 kg at 2.2 m), or its payload
/// if that is more. Its mass is payload times reach times 3 / m. Each link has 0.6 times the mass
/// of the one before it, with the centre of mass near the middle of the link and a little beside
/// it.
struct MassModel {
  std::vector<double> mass;                 // [kg]
  std::vector<Vector3d> com;                // in P_i [m]
  double payload = 0.0;                     // [kg]
  Vector3d payload_com = Vector3d::Zero();  // flange frame [m]
  Vector3d gravity;                         // base frame [m/s^2]
  Drives drives;                            // decide which torque is whose
};

/// The true masses: those that the cell states with a relative error of `share` (1 sigma), and an
/// error of share times 0.1 m of their centres.
MassModel guess_masses(const Cell& cell, const Arm& arm, double share, Random random);

/// The weight of everything behind each joint at one pose, in the base frame.
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
  /// Gravity torque on the drive of revolute joint j [N m]: about the axis of the joint, less that
  /// of the next joint where this one is coupled.
  double torque(int j) const {
    return of_drive(j, [this](int i) { return own_torque(i); });
  }
  /// The part of this torque that the payload causes.
  double payload_torque(int j) const {
    return of_drive(j, [this](int i) { return own_payload_torque(i); });
  }

 private:
  double own_torque(int j) const { return axis_[j].dot(moment(j, origin_[j])); }
  double own_payload_torque(int j) const {
    return axis_[j].dot(moment(static_cast<int>(axis_.size()), origin_[j]));
  }
  template <class Own>
  double of_drive(int j, Own own) const {
    const bool carries = j + 1 < static_cast<int>(axis_.size()) && drives_.is_coupled(j + 1);
    return carries ? own(j) - own(j + 1) : own(j);
  }

  std::vector<double> mass_;            // [kg], links j .. end and payload
  std::vector<Vector3d> first_moment_;  // [kg m]
  std::vector<Vector3d> axis_, origin_;
  Vector3d gravity_;
  Drives drives_;
};

}  // namespace plumb::offline::sim
