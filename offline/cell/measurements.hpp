// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "cell/context_rows.hpp"
#include "cell/joint_columns.hpp"
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
  std::vector<int> placement;  // per row: which placement of an artefact it touches, so that whole
                               // placements are held out; -1: none; empty: no row touches one
  std::vector<int> file;       // per row: which file it was read from, ascending; empty: none
  RowsN q;                     // (n, joints) joint angles [rad] or travels [m]
  Rows3 p_M;                   // measured point, measurement frame [m]; 0 if axis missing
  std::array<bool, 3> has_axis{true, true, true};
  Rows4 quat_M;         // measured orientation (w, x, y, z), or 0 rows
  Rows3 sigma_m;        // 1 sigma per axis from columns, or 0 rows
  Rows3 nominal_B;      // the controller's own position [m], or 0 rows
  Rows3 departure_B;    // nominal_B less the nominal arm [m] (controller_base.hpp), or 0 rows
  ContextRows context;  // what else is known of each pose
  int size() const { return static_cast<int>(q.rows()); }
  bool has_orientation() const { return quat_M.rows() > 0; }
  /// Whether this row says that the target was in a fixed point: touched_points.hpp.
  bool touches_point(Eigen::Index row) const {
    return !placement.empty() && placement[static_cast<std::size_t>(row)] >= 0;
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
