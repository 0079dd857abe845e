// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "fit/calibrate.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// `from` of the result of `plumb fit`: null without an earlier arm.
Json likeness_json(const Cell& cell, const Calibration& found);

/// What was taken over from an earlier arm, in a sentence and a line; empty without one.
std::string likeness_text(const Cell& cell, const Calibration& found);

}  // namespace plumb::offline::show
