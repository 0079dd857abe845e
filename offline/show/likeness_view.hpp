// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fit/calibration.hpp"
#include "show/block.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// Adds `from` to the result of `plumb fit`: null without an earlier arm.
void add_likeness(const Calibration& found, Json& result);

/// What was taken over from an earlier arm, in two notes; nothing without one.
Blocks likeness_notes(const Calibration& found);

}  // namespace plumb::offline::show
