// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "recheck/change.hpp"
#include "runs/run.hpp"

namespace plumb::offline::recheck {

/// Measured orientations of the new readings against those that the calibration held out. A recheck
/// finds what changed from positions; this tells whether something else turns the tool. [rad]
struct TurnCheck {
  ErrorStats then, now;       // now.n = 0: nothing is judged
  double ln_p = 0.0;          // ln of the chance of so large a scatter if nothing has changed
  double constant_rad = 0.0;  // of the turn that is the same for all readings, about the tool
  bool is_constant = false;   // it explains them: the reflector or the last joint turned
  bool judged() const { return now.n > 0; }
  bool turned() const;
};

/// Judges nothing if the run did not fit orientations or the readings have none. Sizes are compared
/// by their medians, so that single bad readings count little.
///
/// @param state  After the changes that were found; with the first set-up only.
/// @param rows   The readings, less those that contradict all others.
/// @param poses  Different ones among them.
/// @param placed A new tool or reflector is assumed or was found: how it is turned nobody knows,
///               and a turn that is the same for all readings says nothing.
TurnCheck check_turns(const Run& calibrated, const ArmState& state, const Measurements& rows,
                      int poses, bool placed);

}  // namespace plumb::offline::recheck
