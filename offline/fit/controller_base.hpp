// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

/// Calibration on top of what the controller itself says (columns nx_mm, ny_mm, nz_mm): it may have
/// a better model than the cell file, absolute accuracy for one.
namespace plumb::offline {

/// From here on the measurements are compared with the controller's positions: what these say
/// beyond the nominal arm goes to `departure_B`, and whatever is fitted comes on top. A frame that
/// the controller sees otherwise does no harm; nor does a tool, but for what the controller knows
/// of orientations, which its positions tell of their own point only. Measured points have no say.
/// Throws Failure (kInput): no such columns, or positions of another arm.
void stand_on_controller(const Cell& cell, MeasurementFiles& measured);

/// The same of rows that are too few to tell frame and tool: those of `measured` are theirs.
void stand_on_controller(const Cell& cell, const MeasurementFiles& measured,
                         MeasurementFiles& rows);

/// How far the controller's positions are from those of the nominal arm, once both share a base
/// frame and a tool [m].
struct Departure {
  double mean = 0.0, max = 0.0;
};
Departure departure_of(const Measurements& measured);

}  // namespace plumb::offline
