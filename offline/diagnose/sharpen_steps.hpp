// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/forward_selection.hpp"

namespace plumb::offline {

/// Which readings found an effect, and which decide where it began.
struct StepReadings {
  const std::vector<int>& choosing;  // rows that chose the effects
  const std::vector<int>& all;       // rows, `choosing` among them
};

/// The moments at which something moved were looked for on some of the readings only. Puts each at
/// the best place among all of them, a few readings of `choosing` away at most, in the step that
/// added it and in the effects of the last one. A place stays where the model without it cannot be
/// fitted. Cost: for every part that moved one nearby fit of `choosing`.
void sharpen_steps(const Cell& cell, const Measurements& measured, const StepReadings& rows,
                   std::vector<ForwardStep>& steps);

}  // namespace plumb::offline
