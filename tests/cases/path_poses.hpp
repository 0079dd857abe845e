// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Where the poses of a measurement lie: anywhere, or with the tool held the same way along a line
/// of 0.4 of the arm's reach, along half a circle on which it turns, or over a square.
enum class PoseField { kAnywhere, kLine, kCurve, kSurface };

/// Poses of a six-axis arm that move its tool there, in the order of the path; (poses, joints)
/// [rad]. The same field_seed gives the same path, and the same seed the same poses on it: evenly
/// spread, and each moved a little along the path at random.
RowsN poses_on(PoseField field, const Cell& cell, int poses, std::uint64_t field_seed,
               std::uint64_t seed);

}  // namespace plumb::offline
