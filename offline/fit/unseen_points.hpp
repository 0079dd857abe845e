// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

/// Artefacts (cell/artefacts.hpp) none of whose rows is fitted. Nobody knows where they are but
/// their own rows, so the model is judged by how far these spread: of a point about their mean, of
/// a plane or a sphere about the one that fits them best.
namespace plumb::offline {

/// Puts each of these artefacts where `state` predicts its rows on average. `fitted`: the rows that
/// `state` was fitted to.
void place_unseen_points(const MeasurementSettings& settings, const Measurements& measured,
                         const std::vector<int>& fitted, ArmState& state);

/// What a model that was fitted to `fitted` predicts of the rows `held`, shape (held, 3). Those of
/// unseen artefacts are moved away so that they are as far as from an artefact that is known
/// otherwise: n lines about what k numbers of their own explain are closer by sqrt(1 - k/n), as
/// three lines a touch about their mean.
Rows3 predict_held_out(const MeasurementSettings& settings, const Measurements& measured,
                       const std::vector<int>& fitted, const std::vector<int>& held,
                       ArmState state);

}  // namespace plumb::offline
