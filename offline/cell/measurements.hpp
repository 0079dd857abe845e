// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cell/contexts.hpp"
#include "cell/kept_rows.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// Kind of quantity a column holds; it decides which units fit.
enum class Quantity {
  kText,
  kNumber,
  kLength,
  kAngle,
  kMass,
  kTemperature,
  kTime,
  kForce,
  kTorque
};

/// One column of a measurement file.
struct Column {
  std::string header;  // as written: "q1_deg"
  std::string name;    // without the unit: "q1"
  std::string unit;    // "deg"; empty for text and plain numbers
  Quantity quantity = Quantity::kText;
  std::vector<double> values;     // SI, temperatures in [degC]; empty for text columns
  std::vector<std::string> text;  // for text columns
};

/// A measurement file as read: columns in file order, all of one length, numbers in SI.
struct Table {
  std::string file;
  std::string sha256;
  std::vector<std::pair<std::string, std::string>> comments;  // "# key: value"
  std::vector<Column> columns;
  std::vector<int> lines;  // source line of each row
  KeptRows raw_rows;       // each row as written, canonical commas, for pass-through
  std::string raw_header;
  int header_line = 0;  // source line of the header
  std::vector<Problem> remarks;
  int rows() const { return static_cast<int>(lines.size()); }
  const Column* find(std::string_view name) const;
};

/// What a table is about; messages propose other names for the columns of a DH table.
enum class TableOf { kMeasurements, kRobot };

/// Reads a CSV file strictly: UTF-8, header with units, no ragged rows, only finite numbers.
/// Throws Failure with all problems (exit 3).
Table read_table(const std::filesystem::path& file, TableOf of = TableOf::kMeasurements);
Table parse_table(std::string_view text, const std::string& file_name,
                  TableOf of = TableOf::kMeasurements);

/// Values with mask: what a file says of the measured point.
using Rows3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Rows4 = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
using RowsN = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

enum class SetMark : char { kUnmarked, kFit, kHeld, kIgnore };

/// Poses and what was measured there. SI; one row a pose; frames as named.
struct Measurements {
  std::vector<std::string> pose;     // id; "1", "2", … if the file has no such column
  std::vector<int> replicate_group;  // equal for repeats of one pose, 0 … groups - 1
  std::vector<SetMark> set;
  std::vector<int> setup;  // per row: which set-up of the cell it was measured in; empty: the only
  RowsN q;                 // (n, joints) [rad] or [m]
  Rows3 p_M;               // measured point, measurement frame [m]; 0 if axis missing
  std::array<bool, 3> has_axis{true, true, true};
  Rows4 quat_M;               // measured orientation (w, x, y, z), or 0 rows
  Rows3 sigma_m;              // 1 sigma per axis from columns, or 0 rows
  Rows3 nominal_B;            // the controller's own position [m], or 0 rows
  Rows3 departure_B;          // that, beyond the arm of the cell (controller_base.hpp), or 0 rows
  ContextRows context;        // what else is known of each pose
  std::vector<Table> tables;  // the files, in order
  int size() const { return static_cast<int>(q.rows()); }
  bool has_orientation() const { return quat_M.rows() > 0; }
};

/// Which columns must be there.
enum class Needs { kJoints, kJointsAndPosition };

/// Reads measurement files of an arm with `joint_is_angle.size()` joints and joins them.
/// Throws Failure with all problems of all files (exit 3): missing q1 … qn, quaternions not of unit
/// length, no measured axis, no rows, too many joints.
Measurements read_measurements(const std::vector<std::filesystem::path>& files,
                               const std::vector<bool>& joint_is_angle, Needs needs);

/// Rows picked by index, in that order.
Measurements pick(const Measurements& all, const std::vector<int>& rows);

/// Canonical CSV: pose, q1_deg …, x_mm …, with comments on top; reads back to 1e-12.
/// `extra` columns are appended as given.
std::string write_measurements(const Measurements& measurements,
                               const std::vector<bool>& joint_is_angle,
                               const std::vector<std::pair<std::string, std::string>>& comments,
                               const std::vector<Column>& extra);

}  // namespace plumb::offline
