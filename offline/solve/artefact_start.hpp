// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/arm_state.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Where an artefact (cell/artefacts.hpp) may stand by where `state` has the target in its rows,
/// which are all of `measured`: `state` with the frame and the length of that set-up, one of them
/// for each guess. Planes may lie across any of the three axes of those points; centres are
/// where the distances meet by linear least squares. fit_length: the length is unknown. At least
/// one. Cost: rows.
std::vector<ArmState> artefact_starts(const Measurements& measured, const ArmState& state,
                                      int setup, bool fit_length);

}  // namespace plumb::offline
