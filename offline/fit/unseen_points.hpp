// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

/// Touched points (cell/touched_points.hpp) none of whose rows is fitted. Nobody knows where they
/// are but their own rows, so the model is judged by how far these spread about their mean.
namespace plumb::offline {

/// Puts each of these points where `state` predicts its rows on average. `fitted`: the rows that
/// `state` was fitted to.
void place_unseen_points(const MeasurementSettings& settings, const Measurements& measured,
                         const std::vector<int>& fitted, ArmState& state);

/// Moves the predictions of their rows away from the mean so that they are as far from it as from a
/// point that is known otherwise: n readings about their own mean are closer by the factor
/// sqrt(1 - 1/n). predicted_M: shape (rows of `measured`, 3).
void widen_about_unseen_points(const MeasurementSettings& settings, const Measurements& measured,
                               const std::vector<int>& fitted, const std::vector<int>& held,
                               Rows3& predicted_M);

}  // namespace plumb::offline
