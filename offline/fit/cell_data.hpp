// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Reads the measurements of a cell, the file of held-out poses last. Lists the fixed points that
/// they touch as set-ups of the cell (cell/artefacts.hpp). Throws Failure (kInput) if a
/// file is missing, if an earlier run has seen these readings, or as `check_rows`.
MeasurementFiles read_cell_measurements(Cell& cell);

/// Throws Failure (kInput, E-EFFECT-DATA) if an effect begins after the last row.
void check_rows(const Cell& cell, const Measurements& measured);

}  // namespace plumb::offline
