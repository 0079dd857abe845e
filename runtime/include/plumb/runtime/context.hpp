// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "plumb/format/limits.hpp"

namespace plumb {

/// The value of an input that is not known now; an effect then uses its declared fallback.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// What is known about a pose besides its joint positions. SI units, temperatures in [degC].
/// The members of the first group are known in the cycle. Those of the second group are known only
/// for measured poses, where they depend on the order of measurement.
struct Context {
  std::array<double, format::kMaxJoints> direction = unknown();  // sign of each joint's last move
  std::array<double, format::kMaxJoints> travel = unknown();     // size of that move [rad] or [m]
  double payload_kg = kUnknown;
  std::array<double, 3> payload_com_m{kUnknown, kUnknown, kUnknown};  // flange frame
  std::array<double, format::kMaxTemperatures> temperature_degC = unknown_temperatures();
  double time_s = kUnknown;
  std::array<double, 3> force_N{};  // external, on the tool tip, base frame
  std::array<double, 3> moment_Nm{};

  double order = kUnknown;                                  // index in the series, 0, 1, …
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
