// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Frame X_MB that lays predicted base points on measured ones in the least-squares sense
/// [Arun 1987, Umeyama 1991], proper rotation. With a missing axis the points are taken as flat.
/// p_B, p_M: shape (n, 3) [m], n >= 1.
format::Pose align(const Rows3& p_B, const Rows3& p_M);

/// Frames and reflectors as the cell gives them, and which set-ups share them; what is to be fitted
/// stays at the identity.
void place_as_given(const MeasurementSettings& settings, ArmState& state);

/// X_TG's rotation that fits the measured orientations best on average; `rows` are of one set-up.
std::array<double, 4> align_target(const ArmState& state, const Measurements& measured,
                                   const std::vector<int>& rows);

}  // namespace plumb::offline
