// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "plumb/format/model.hpp"
#include "runs/run.hpp"

namespace plumb::offline {

/// The model of a run: nominal and calibrated chain, trees, trained domain, guard, provenance.
/// Frame and target belong to the measurement and stay out. Orientation is corrected only if it was
/// measured and fitted.
format::Model compile(const Cell& cell, const Run& run);

/// Whether an effect goes into the model. The others belong to the measurement; they are fitted
/// only so that they do not falsify the other parameters.
bool runs_online(const format::Effect& effect);

}  // namespace plumb::offline
