// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

/// Readings without an instrument that measures positions: a ball in a socket, a probe on a plate,
/// a ball bar, a dial gauge, a draw wire. A file of such rows has a text column `point`, `plane`,
/// `sphere` or `anchor` and no measured position. All rows with one label are about one artefact
/// that stands still, and nobody needs to know where it is.
///
/// Each artefact is a set-up: its frame stands in the point or the centre, or on the plane with z
/// along the normal, and all of them share one target. So its unknown numbers are those of a frame,
/// and a residual is how far the model has the target from where the reading says that it is.
namespace plumb::offline {

/// What the rows of the table say: positions, if none of those columns is there. Labels of points
/// that are all different are names of measured points whose coordinates are missing.
ReadingKind kind_of(const Table& table);

/// Whether its rows are about artefacts.
inline bool reads_artefact(const Table& table) { return kind_of(table) != ReadingKind::kPosition; }

/// The column that names the artefact of each row; null where the rows are positions.
const Column* artefact_column(const Table& table);

/// What each row read there, null where nothing was read but the joints.
const Column* value_column(const Table& table);

/// Lists every artefact of these tables as a set-up of the cell, and every distance between two
/// points that the columns `to_point` and `distance` state. Where other rows have measured
/// positions and the cell lists no set-up, [measurement] itself becomes the first one. Throws
/// Failure (kInput, E-CSV-POINT) for rows without a label, for columns that lack another one, and
/// for distances or radii that contradict each other.
void list_artefacts(const std::vector<Table>& tables, MeasurementSettings& settings);

/// The placement of each row: by the column `position`, else by the artefact. Rows of an artefact
/// that has no more readings than unknown numbers are ignored (W-CSV-POINT), for they say nothing.
void assign_placements(const MeasurementSettings& settings, MeasurementFiles& measured);

/// Whether the readings of this set-up are about an artefact.
inline bool of_artefact(const MeasurementSettings& settings, int setup) {
  const auto k = static_cast<std::size_t>(setup);
  return k < settings.setups.size() && settings.setups[k].is_artefact();
}

/// Whether any of them are.
inline bool has_artefacts(const MeasurementSettings& settings) {
  return std::any_of(settings.setups.begin(), settings.setups.end(),
                     [](const Setup& s) { return s.is_artefact(); });
}

/// Whether nothing that was read is a length, and no joint slides: then the shape of the arm shows,
/// but not its size.
bool lacks_length(const Cell& cell);

}  // namespace plumb::offline
