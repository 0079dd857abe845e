// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "cell/cell.hpp"

namespace plumb::offline::sim {

/// A heavy six-axis arm from table 2 of the published study with an assumed sixth axis. No masses
/// are stated.
Cell heavy_arm();

/// A light six-axis arm similar to a UR10. No masses are stated.
Cell light_arm();

/// The heavy arm on a track of 3 m: seven joints, the first of which slides along y.
Cell track_arm();

/// A SCARA, whose third joint slides. Gravity turns none of its joints.
Cell scara_arm();

/// A palletiser: five joints, the fourth of which keeps the flange level, q4 = -(q2 + q3). Its
/// joints 3 and 4 are turned by parallelograms (kPalletiserCoupled).
Cell palletiser_arm();
inline constexpr std::array kPalletiserCoupled{2, 3};

/// States nominal masses of the links, as a data sheet would, so that the true ones can differ from
/// them.
void state_masses(Cell& cell, double moving_kg);

}  // namespace plumb::offline::sim
