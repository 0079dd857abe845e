// SPDX-License-Identifier: Apache-2.0
#include "check/data_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cell/column_names.hpp"
#include "cell/table_place.hpp"
#include "check/arm_shape.hpp"
#include "check/constants.hpp"
#include "check/displaced_run.hpp"
#include "check/row_lines.hpp"

namespace plumb::offline {
namespace {

std::string shown(const format::JointRow& row, double q) {
  return row.type == format::JointType::kPrismatic
             ? fmt::format("{:.1f} mm", q * 1e3)
             : fmt::format("{:.1f} deg", q / check::kDegree_rad);
}

bool inside(const format::JointRow& row, double q) {
  return q >= row.q_min - check::kBeyondLimit && q <= row.q_max + check::kBeyondLimit;
}

bool inside_after_a_turn(const format::JointRow& row, double q) {
  const bool turns = row.type == format::JointType::kRevolute;
  return turns && (inside(row, q - 2.0 * M_PI) || inside(row, q + 2.0 * M_PI));
}

bool is_context(const Column& column) {
  if (column.name == "pose" || column.name == "repeat" || column.values.empty()) return false;
  if (joint_number(column.name, "q") > 0) return false;
  static const std::vector<std::string> known{"x",  "y",  "z",  "sx", "sy", "sz", "nx", "ny",
                                              "nz", "qw", "qx", "qy", "qz", "rx", "ry", "rz"};
  return std::find(known.begin(), known.end(), column.name) == known.end();
}

bool is_constant(const Column& column) {
  const auto [low, high] = std::minmax_element(column.values.begin(), column.values.end());
  return *low == *high;
}

bool assumed(const Cell& cell, int joint) {
  const auto at = static_cast<std::size_t>(joint);
  return at < cell.assumed_limits.size() && cell.assumed_limits[at];
}

/// A note, not an error: the exceeded limits were assumed, because the cell file states none.
Problem beyond_assumed(const Cell& cell, const MeasurementFiles& measured, int joint) {
  const auto& row = cell.nominal.joints[static_cast<std::size_t>(joint)];
  const auto q = measured.q.col(joint);
  return {Severity::kNote, "N-CHECK-LIMITS",
          fmt::format("{} goes from {} to {}; the cell file states no limits of it, and {} to {} "
                      "were assumed",
                      row.name, shown(row, q.minCoeff()), shown(row, q.maxCoeff()),
                      shown(row, row.q_min), shown(row, row.q_max)),
          std::nullopt,
          fmt::format("state the limits of {} in cell.toml: q = [min, max]", row.name)};
}

}  // namespace

std::vector<Problem> limit_findings(const Cell& cell, const MeasurementFiles& measured) {
  std::vector<Problem> out;
  for (int j = 0; j < cell.joints(); ++j) {
    const auto& row = cell.nominal.joints[j];
    std::vector<int> beyond;
    bool turn = true;
    for (int i = 0; i < measured.size(); ++i) {
      const double q = measured.q(i, j);
      if (inside(row, q)) continue;
      beyond.push_back(i);
      turn = turn && inside_after_a_turn(row, q);
    }
    if (beyond.empty()) continue;
    if (assumed(cell, j)) {
      out.push_back(beyond_assumed(cell, measured, j));
      continue;
    }
    const int first = beyond.front();
    out.push_back(
        {Severity::kWarning, "W-CHECK-LIMITS",
         fmt::format("{} is beyond its limits {} to {} in {} of {} rows, {}{}", row.name,
                     shown(row, row.q_min), shown(row, row.q_max), beyond.size(), measured.size(),
                     listed_lines(measured, beyond),
                     turn ? "; a whole turn less or more would be inside" : ""),
         cell_of_row(measured, first, fmt::format("q{}", j + 1), shown(row, measured.q(first, j))),
         turn ? fmt::format("if {0} counts turns like this on the controller too, widen its limits "
                            "q in cell.toml; else take 360 deg off or add them in these rows",
                            row.name)
              : fmt::format("correct the rows, or in cell.toml the limits q of {}", row.name)});
  }
  return out;
}

std::vector<Problem> outlier_findings(const MeasurementFiles& measured,
                                      const Calibration& calibration) {
  const auto& outliers = calibration.outliers;
  if (outliers.empty()) return {};
  std::vector<int> rows;
  for (const auto& outlier : outliers) rows.push_back(outlier.row);
  const Outlier& first = outliers.front();
  std::string runs;
  for (const auto& run : displaced_runs(calibration.state, measured, outliers))
    runs += "; " + in_words(measured, run);
  return {
      {Severity::kWarning, "W-CHECK-OUTLIER",
       fmt::format("{} {} by the others, {}: the farthest by {:.3g} mm, {:.0f} times the usual{}",
                   rows.size(),
                   rows.size() == 1 ? "reading is contradicted" : "readings are contradicted",
                   listed_lines(measured, rows), first.error_m * 1e3, first.times, runs),
       cell_of_row(measured, first.row, measured.has_axis[0] ? "x" : "y", "does not belong"),
       "measure these poses again, or mark the rows with set = ignore"}};
}

std::vector<Problem> constant_findings(const Cell& cell, const MeasurementFiles& measured) {
  std::vector<Problem> out;
  for (int j = 0; j < cell.joints(); ++j) {
    const auto q = measured.q.col(j);
    if (q.maxCoeff() - q.minCoeff() >= check::kStill) continue;
    out.push_back(
        {Severity::kWarning, "W-CHECK-STILL",
         fmt::format("{} never moves: it stays at {}", cell.nominal.joints[j].name,
                     shown(cell.nominal.joints[j], q(0))),
         cell_of_row(measured, 0, fmt::format("q{}", j + 1), "the same in every row"),
         fmt::format("add poses that move {} by more than 60 deg", cell.nominal.joints[j].name)});
  }
  for (const auto& table : measured.tables)
    for (const auto& column : table.columns)
      if (is_context(column) && is_constant(column))
        out.push_back({Severity::kNote, "N-CHECK-CONSTANT",
                       fmt::format("column '{}' holds one value only", column.header),
                       place_in_header(table, column, "the same in every row"),
                       "what it stands for can be tested only if it varies"});
  return out;
}

std::vector<Problem> repeat_findings(const Cell& cell, const NoiseFloor& floor) {
  const auto& stated = cell.measurement.sigma_m;
  if (floor.source != NoiseFloor::Source::kRepeats || !stated) return {};
  const bool more = floor.sigma_m >= check::kNoiseOtherwise * *stated;
  const bool less = floor.sigma_m * check::kNoiseOtherwise <= *stated;
  if (!more && !less) return {};
  return {{Severity::kWarning, "W-CHECK-REPEATS",
           fmt::format("repeats of a pose scatter by {:.3g} mm an axis (1 sigma), but sigma_um "
                       "says {:.3g} mm",
                       floor.sigma_m * 1e3, *stated * 1e3),
           std::nullopt,
           more ? "are rows of one name the same pose, reached alike? else correct sigma_um"
                : "correct sigma_um: with one that is too large effects go unseen"}};
}

}  // namespace plumb::offline
