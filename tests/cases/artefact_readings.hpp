// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tests/cases/socket_arm.hpp"

namespace plumb::offline {

/// Readings of artefacts that stand still somewhere in the reach of an arm.
struct ArtefactPlan {
  enum class Kind {
    kPlane,     // a ball touches a plate
    kHeight,    // a dial gauge above it: column height_mm
    kSphere,    // a ball bar of unknown length
    kBall,      // of a known one: column radius_mm
    kDistance,  // a distance to an anchor: column distance_mm
    kWire,      // a draw wire whose zero is unknown: column extension_mm
  };
  Kind kind = Kind::kPlane;
  int artefacts = 6;
  int readings = 20;       // of each
  double sigma_m = 20e-6;  // of a reading
  double moved_m = 0.0;    // the first artefact moves by this along z half-way through its readings
};

/// measurements.csv of such readings. Distances are 0.4 to 1.2 m, spheres have 120 mm, the zero of
/// a wire is 312.7 mm.
std::string artefact_readings(SocketArm& arm, const ArtefactPlan& plan);

}  // namespace plumb::offline
