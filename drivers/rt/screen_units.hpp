// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace plumb::drivers::rt {

/// Units of rt.toml and of the screens, in SI: a length in mm times kMilli is one in m.
inline constexpr double kMilli = 1e-3;
inline constexpr double kMicro = 1e-6;
inline constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace plumb::drivers::rt
