// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Which joints of the cell turn (true) and which slide.
std::vector<bool> joint_is_angle(const Cell& cell);

/// The measurements of a cell, the held-out file of its rule last.
Measurements read_cell_measurements(const Cell& cell);

}  // namespace plumb::offline
