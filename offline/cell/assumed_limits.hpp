// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

/// Joint limits where none are given: wide, so that no sound pose lies outside.
/// `Cell::assumed_limits` says which joints have them.
namespace plumb::offline {

inline constexpr double kAssumedTurn = 2.0 * std::numbers::pi;  // either way [rad]
inline constexpr double kAssumedTravel_m = 10.0;                // either way, of a sliding joint

}  // namespace plumb::offline
