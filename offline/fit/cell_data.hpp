// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Which joints of the cell turn (true) and which slide.
std::vector<bool> joint_is_angle(const Cell& cell);

/// The measurements of a cell, the held-out file of its rule last; rows checked as below.
MeasurementFiles read_cell_measurements(const Cell& cell);

/// Throws Failure (kInput, E-EFFECT-DATA) if an effect begins behind the last row.
void check_rows(const Cell& cell, const Measurements& measured);

}  // namespace plumb::offline
