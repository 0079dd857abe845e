// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline::sim {

/// A tapered cantilever. Its diameter is (1 - taper s / length) times that at the root, so the
/// bending stiffness EI decreases with the fourth power of this factor and the weight per length
/// with the second.
struct TaperedBeam {
  double length = 1.0;            // [m]
  double EI = 1.0;                // bending stiffness at the root [N m^2]
  double GJ_over_EI = 1.0 / 1.3;  // round bar, Poisson's ratio 0.3
  double taper = 0.4;             // 0 for a constant section
  double mass = 0.0;              // distributed over the length [kg]
};

/// Motion of the free end, in the frame of the arguments.
struct BeamEnd {
  Eigen::Vector3d displacement;  // [m]
  Eigen::Vector3d rotation;      // [rad]
};

/// Small bending and torsion under force [N] and moment [N m] at the free end and its own weight;
/// `along` is the unit vector from root to free end, gravity in [m/s^2]. Integrated numerically
/// over the length (Simpson, 128 intervals; exact for a constant section).
BeamEnd bend(const TaperedBeam& beam, const Eigen::Vector3d& along, const Eigen::Vector3d& force,
             const Eigen::Vector3d& moment, const Eigen::Vector3d& gravity);

}  // namespace plumb::offline::sim
