// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "cell/context_rows.hpp"
#include "cell/joint_columns.hpp"
#include "cell/reading_kind.hpp"
#include "cell/rows.hpp"
#include "cell/table.hpp"

namespace plumb::offline {

enum class SetMark : char { kUnmarked, kFit, kHeld, kIgnore };

/// Poses and what was measured there, one row per reading. SI. Suffix _M: measurement frame, _B:
/// base frame.
struct Measurements {
  std::vector<std::string> pose;     // id; "1", "2", … if the file has no such column
  std::vector<int> replicate_group;  // equal for repeats of one pose, 0 … groups - 1
  std::vector<SetMark> set;
  std::vector<int> setup;  // per row: which set-up of the cell it was measured in; empty: the only
  std::vector<ReadingKind> kind;  // per row; empty: all are positions
  std::vector<int> placement;  // per row: which placement of an artefact it is about, so that whole
                               // placements are held out; -1: none; empty: no row is about one
  std::vector<int> file;       // per row: which file it was read from, ascending; empty: none
  RowsN q;                     // (n, joints) joint angles [rad] or travels [m]
  Rows3 p_M;                   // what was read, measurement frame [m]; 0 if axis missing
  std::array<bool, 3> has_axis{true, true, true};  // of positions; without any, of artefacts
  Rows4 quat_M;                                    // measured orientation (w, x, y, z), or 0 rows
  Rows3 sigma_m;                                   // 1 sigma per axis from columns, or 0 rows
  Rows3 nominal_B;                                 // the controller's own position [m], or 0 rows
  Rows3 departure_B;    // nominal_B less the nominal arm [m] (controller_base.hpp), or 0 rows
  ContextRows context;  // what else is known of each pose
  int size() const { return static_cast<int>(q.rows()); }
  bool has_orientation() const { return quat_M.rows() > 0; }
  ReadingKind kind_of(Eigen::Index row) const {
    return kind.empty() ? ReadingKind::kPosition : kind[static_cast<std::size_t>(row)];
  }
  bool of_artefact(Eigen::Index row) const { return kind_of(row) != ReadingKind::kPosition; }
  /// Whether this row reads coordinate 0 to 2 of p_M.
  bool reads(Eigen::Index row, int axis) const {
    const auto k = static_cast<std::size_t>(axis);
    return of_artefact(row) ? descriptor_of(kind_of(row)).reads[k] : has_axis[k];
  }
  /// How many coordinates of p_M are read in a row on average.
  double mean_axes() const;
  /// The same as a whole number, at least 1: of rows that all read as much, that.
  int usual_axes() const;
  /// How many coordinates the row reads.
  int axes(Eigen::Index row) const {
    return int{reads(row, 0)} + int{reads(row, 1)} + int{reads(row, 2)};
  }
};

/// Measurements with the tables that they were read from, for code that quotes lines, columns or
/// comments of a file.
struct MeasurementFiles : Measurements {
  std::vector<Table> tables;  // in order; together they have as many rows
};

/// Rows picked by index, in that order.
Measurements pick(const Measurements& all, const std::vector<int>& rows);
MeasurementFiles pick(const MeasurementFiles& all, const std::vector<int>& rows);

/// Canonical CSV: pose, q1_deg …, x_mm …, with comments on top; reads back to 1e-12.
/// `extra` columns are appended as given.
std::string write_measurements(const Measurements& measurements, const JointColumns& joints,
                               const std::vector<std::pair<std::string, std::string>>& comments,
                               const std::vector<Column>& extra);

}  // namespace plumb::offline
