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

/// What a model that was fitted to `fitted` predicts of the rows `held`, shape (held, 3). Those of
/// unseen points are moved away from their mean so that they are as far from it as from a point
/// that is known otherwise: n readings about their own mean are closer by the factor sqrt(1 - 1/n).
Rows3 predict_held_out(const MeasurementSettings& settings, const Measurements& measured,
                       const std::vector<int>& fitted, const std::vector<int>& held,
                       ArmState state);

}  // namespace plumb::offline
