// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/measurements.hpp"
#include "fit/arm_state.hpp"

namespace plumb::offline {

/// Frame X_MB that lays predicted base points on measured ones in the least-squares sense
/// [Arun 1987, Umeyama 1991], proper rotation. With a missing axis the points are taken as flat.
/// p_B, p_M: shape (n, 3) [m], n >= 1.
format::Pose align(const Rows3& p_B, const Rows3& p_M);

/// X_TG's rotation that fits the measured orientations best on average.
std::array<double, 4> align_target(const ArmState& state, const Measurements& measured,
                                   const std::vector<int>& rows);

}  // namespace plumb::offline
