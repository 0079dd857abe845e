// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fit/measured_orientations.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// The kind as JSON has it: "scattered".
const char* name_of(MeasuredOrientations::Kind kind);

/// What the measured orientations are, in one sentence without full stop; empty if there is nothing
/// to say. meant: descriptions of the interpretations that fit.
std::string in_words(const MeasuredOrientations& judged, const std::vector<std::string>& meant);

/// What the user can do about it; empty if there is nothing to do.
std::string remedy(const MeasuredOrientations& judged);

/// The value that sigma_urad should have, with two digits.
std::string sigma_urad_to_state(const MeasuredOrientations& judged);

/// W-FIT-ORIENTATION or N-FIT-ORIENTATION; nothing where they are fitted as stated.
std::optional<Problem> orientation_remark(const MeasuredOrientations& judged);

}  // namespace plumb::offline
