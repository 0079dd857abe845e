// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

/// Calibration on top of what the controller itself says (columns nx_mm, ny_mm, nz_mm): it may have
/// a better model than the cell file, absolute accuracy for one.
namespace plumb::offline {

/// From here on the measurements are compared with the controller's positions: what these say
/// beyond the nominal arm goes to `departure_B`, and whatever is fitted comes on top. The
/// controller may use another base frame and another tool: both are fitted first. With another
/// tool, though, corrections of orientation that the controller makes are known at its own tool
/// point only. Measured points play no part in this.
///
/// Throws Failure (kInput): no such columns, or positions of another arm.
void stand_on_controller(const Cell& cell, MeasurementFiles& measured);

/// The same for rows that may be too few to fit frame and tool: these are fitted to `measured`.
void stand_on_controller(const Cell& cell, const MeasurementFiles& measured,
                         MeasurementFiles& rows);

/// How far the controller's positions are from those of the nominal arm, once both share a base
/// frame and a tool [m].
struct Departure {
  double mean = 0.0, max = 0.0;
};
Departure departure_of(const Measurements& measured);

}  // namespace plumb::offline
