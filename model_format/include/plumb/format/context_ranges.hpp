// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "plumb/format/limits.hpp"

/// The ranges of context inputs that a model may contain (ContextRange).
namespace plumb::format {

/// Names of the ranges of ContextInput::kPayload: the mass on the flange [kg] (no name), its centre
/// of mass in the flange frame [m] (c.), and the external force [N] (f.) and moment [N m] (m.) on
/// the tool tip in the base frame.
inline constexpr std::array<std::string_view, 10> kLoadNames{"",   "cx", "cy", "cz", "fx",
                                                             "fy", "fz", "mx", "my", "mz"};

/// A model may contain each of these once, and one range for each temperature.
inline constexpr std::size_t kMaxContextRanges = kLoadNames.size() + kMaxTemperatures;

}  // namespace plumb::format
