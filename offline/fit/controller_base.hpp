// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

/// Calibration relative to the positions that the controller itself reports (columns nx_mm, ny_mm,
/// nz_mm). Its model may be better than that of the cell file, as with an absolute-accuracy option.
namespace plumb::offline {

/// Makes a fit start from the controller's positions: their differences from the nominal arm are
/// stored in `departure_B`, and the fitted numbers add to them. The base frame and the tool of the
/// controller, which may be others than those of the cell, are fitted first. If the tools differ,
/// the effect of the controller's own orientation corrections is known only at its tool point.
/// Measured points are not used.
///
/// Throws Failure (kInput) if there are no such columns, or if the positions are of another arm.
void stand_on_controller(const Cell& cell, MeasurementFiles& measured);

/// The same for `rows` that may be too few to fit frame and tool, which are fitted to `measured`.
void stand_on_controller(const Cell& cell, const MeasurementFiles& measured,
                         MeasurementFiles& rows);

/// Distance of the controller's positions from those of the nominal arm with the same base frame
/// and tool [m].
struct Departure {
  double mean = 0.0, max = 0.0;
};
Departure departure_of(const Measurements& measured);

}  // namespace plumb::offline
