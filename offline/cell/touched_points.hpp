// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

/// Fixed points that the tool touches: a ball in a socket, a pin in a hole, a pointed tip on a
/// mark. A file of such rows has the text column `point` and no measured position. All rows with
/// one label have the target in the same point, and nobody needs to know where it is.
///
/// Each point is a set-up: its frame has the axes of the base and stands in the point, the position
/// read there is 0 0 0, and all points share one target. So three numbers of a point are fitted,
/// and every residual is the vector from where the model has the target to the point.
namespace plumb::offline {

/// Whether the rows of the table touch fixed points: labels that are all different are names of
/// measured points whose coordinates are missing.
bool touches(const Table& table);

/// Lists every point that these tables touch as a set-up of the cell, and every distance between
/// two of them that the columns `to_point` and `distance` state. Where other rows have measured
/// positions and the cell lists no set-up, [measurement] itself becomes the first one. Throws
/// Failure (kInput, E-CSV-POINT) for rows without a label and for distances that contradict each
/// other.
void list_touched_points(const std::vector<Table>& tables, MeasurementSettings& settings);

/// The placement of each row: by the column `position`, else by the point. Rows of a point that is
/// touched only once are ignored (W-CSV-POINT), for they say nothing.
void assign_placements(const MeasurementSettings& settings, MeasurementFiles& measured);

/// Whether the reading of this row is that the target was in a fixed point.
inline bool touches_point(const MeasurementSettings& settings, int setup) {
  const auto k = static_cast<std::size_t>(setup);
  return k < settings.setups.size() && settings.setups[k].is_point;
}

/// Whether all readings are of fixed points, no distance is known and no joint slides: then the
/// shape of the arm shows, but not its size.
bool lacks_length(const Cell& cell);

}  // namespace plumb::offline
