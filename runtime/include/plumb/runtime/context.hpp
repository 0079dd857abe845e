// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "plumb/format/limits.hpp"

namespace plumb {

/// Not known now: an effect then uses its declared fallback.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// What is known of a pose besides its joint positions. SI, temperatures in [degC].
/// The first group is known in the cycle; the second only of measured poses, in their order.
struct Context {
  std::array<double, format::kMaxJoints> direction = unknown();  // sign of each joint's last move
  std::array<double, format::kMaxJoints> travel = unknown();     // its size [rad] or [m]
  double payload_kg = kUnknown;
  std::array<double, 3> payload_com_m{kUnknown, kUnknown, kUnknown};  // flange frame
  std::array<double, format::kMaxTemperatures> temperature_degC = unknown_temperatures();
  double time_s = kUnknown;
  std::array<double, 3> force_N{};  // external, on the tool tip, base frame
  std::array<double, 3> moment_Nm{};

  double order = kUnknown;                                  // place in the series, 0, 1, …
  std::array<double, format::kMaxJoints> step = unknown();  // last move / largest of all joints
  std::array<double, 3> tracker_B{kUnknown, kUnknown, kUnknown};  // origin of the tracker [m]
  std::array<double, 3> tracker_up_B{0.0, 0.0, 1.0};              // its vertical axis

  static constexpr std::array<double, format::kMaxJoints> unknown() {
    std::array<double, format::kMaxJoints> out{};
    for (auto& v : out) v = kUnknown;
    return out;
  }
  static constexpr std::array<double, format::kMaxTemperatures> unknown_temperatures() {
    std::array<double, format::kMaxTemperatures> out{};
    for (auto& v : out) v = kUnknown;
    return out;
  }
};

inline constexpr Context kNothingKnown{};

}  // namespace plumb
