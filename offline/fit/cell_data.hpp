// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// The measurements of a cell, the held-out file of its rule last; rows checked as below.
MeasurementFiles read_cell_measurements(const Cell& cell);

/// Throws Failure (kInput, E-EFFECT-DATA) if an effect begins behind the last row.
void check_rows(const Cell& cell, const Measurements& measured);

}  // namespace plumb::offline
