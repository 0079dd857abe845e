// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Frame X_MB that lays predicted base points on measured ones in the least-squares sense
/// [Arun 1987, Umeyama 1991], proper rotation. Coordinates of an axis that was not measured are
/// taken as 0.
/// p_B, p_M: shape (n, 3) [m], n >= 1.
format::Pose align(const Rows3& p_B, const Rows3& p_M);

/// Sets the frames and reflectors of `state` as the cell gives them, and which set-ups share them.
/// Those that are to be fitted become the identity.
void place_as_given(const MeasurementSettings& settings, ArmState& state);

/// The rotation of X_TG that fits the measured orientations of `rows`, all of one set-up, best on
/// average.
std::array<double, 4> align_target(const ArmState& state, const Measurements& measured,
                                   const std::vector<int>& rows);

}  // namespace plumb::offline
