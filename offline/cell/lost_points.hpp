// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Marks readings that are no points of this arm as 'ignore', with a warning (W-CSV-LOST) that
/// names their lines: exactly (0, 0, 0), which is the tracker itself, where it stands for a lost
/// beam, and what is farther from the other points than the arm and any tool reach, such as -9999.
/// Where they are more than a fifth of a set-up, something else is wrong, and nothing is marked.
/// After assign_setups.
void ignore_lost_points(const Cell& cell, MeasurementFiles& measured);

}  // namespace plumb::offline
