// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// W-FIT-UNIT: distances to anchors that the nominal arm can meet only if their numbers are in
/// another unit, inches in a column of millimetres for example. Added to the remarks of their
/// table. Silent where an anchor has too few readings. Cost: rows.
void warn_of_distance_unit(const Cell& cell, MeasurementFiles& measured);

}  // namespace plumb::offline
