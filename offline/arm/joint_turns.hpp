// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "arm/arm_state.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// How much of the turn of the target in each row goes about the axis of each joint [rad], shape
/// (n, joints); 0 of a joint that slides. Uses the frames of the chain alone.
///
/// @param turned_G  Rotation vectors in the target's frame [rad], shape (n, 3): turns_of_target.
RowsN turns_about_joints(const ArmState& state, const Measurements& at, const Rows3& turned_G);

}  // namespace plumb::offline
