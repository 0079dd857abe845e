// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/measurements.hpp"
#include "solve/solver.hpp"

namespace plumb::offline {

/// Where an artefact (cell/artefacts.hpp) may stand by where `state` has the target in its rows,
/// which are all of `measured`: `state` with the frame and the length of that set-up, one of them
/// for each guess. Planes may lie across any of the three axes of those points; centres are
/// where the distances meet by linear least squares. fit_length: the length is unknown. At least
/// one. Cost: rows.
std::vector<ArmState> artefact_starts(const Measurements& measured, const ArmState& state,
                                      int setup, bool fit_length);

/// The artefact of one set-up, to which all rows of `data` belong, from the likeliest of these
/// starts: that from which `fit` ends with the smallest cost. What is left of a wrong one is far
/// larger.
Solution placed_artefact(const FitData& data, const ArmState& state, int setup, bool fit_length,
                         const std::function<Solution(const ArmState& start)>& fit);

}  // namespace plumb::offline
