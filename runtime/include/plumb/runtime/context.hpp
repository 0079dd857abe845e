// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "plumb/format/limits.hpp"

namespace plumb {

/// The value of an input that is not known now; an effect then uses its declared fallback.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// What is known in the cycle about a pose besides its joint positions. SI units, temperatures in
/// [degC].
struct Context {
  std::array<double, format::kMaxJoints> direction = unknown();  // of each last move: -1, 0 or +1
  std::array<double, format::kMaxJoints> travel = unknown();     // size of that move [rad] or [m]
  double payload_kg = kUnknown;
  std::array<double, 3> payload_com_m{kUnknown, kUnknown, kUnknown};  // flange frame
  std::array<double, format::kMaxTemperatures> temperature_degC = unknown_temperatures();
  double time_s = kUnknown;           // process time [s]
  std::array<double, 3> force_N{};    // external, on the tool tip, base frame
  std::array<double, 3> moment_Nm{};  // external, about the tool tip, base frame

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
