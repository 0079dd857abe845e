// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fit/measured_orientations.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// "scattered", for JSON.
const char* name_of(MeasuredOrientations::Kind kind);

/// What the measured orientations are, in one sentence without full stop; empty if there is nothing
/// to say. `meant`: the readings that fit, in words.
std::string in_words(const MeasuredOrientations& judged, const std::vector<std::string>& meant);

/// What to do about it.
std::string remedy(const MeasuredOrientations& judged);

/// The value to state as sigma_urad, in two digits.
std::string sigma_urad_to_state(const MeasuredOrientations& judged);

/// W-FIT-ORIENTATION or N-FIT-ORIENTATION; nothing where they are fitted as stated.
std::optional<Problem> orientation_remark(const MeasuredOrientations& judged);

}  // namespace plumb::offline
