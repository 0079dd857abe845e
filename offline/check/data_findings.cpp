// SPDX-License-Identifier: Apache-2.0
#include "check/data_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cell/column_names.hpp"
#include "cell/table_place.hpp"
#include "check/arm_shape.hpp"

namespace plumb::offline {
namespace {

constexpr double kBeyond = 1e-3;         // [rad] or [m]: less is rounding of the limits
constexpr std::size_t kLinesListed = 5;  // lines named in one message
constexpr double kOnePlace = 5e-3;       // [m]: readings of one pose hardly differ by more
constexpr double kOneDegree = M_PI / 180.0;

std::string lines_of(const Measurements& measured, const std::vector<int>& rows) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < std::min(rows.size(), kLinesListed); ++k) {
    const RowPlace at = row_place(measured, rows[k]);
    lines.push_back(fmt::format("{}", measured.tables[at.table].lines[at.row]));
  }
  return fmt::format("{} {}{}", rows.size() == 1 ? "line" : "lines", fmt::join(lines, ", "),
                     rows.size() > kLinesListed ? ", ..." : "");
}

std::optional<Place> cell_of(const Measurements& measured, int row, const std::string& column,
                             std::string label) {
  if (measured.tables.empty()) return std::nullopt;
  const RowPlace at = row_place(measured, row);
  const Table& table = measured.tables[at.table];
  const Column* found = table.find(column);
  if (found == nullptr) return Place{.file = table.file};
  return place_in_row(table, at.row, *found, std::move(label));
}

std::string shown(const format::JointRow& row, double q) {
  return row.type == format::JointType::kPrismatic ? fmt::format("{:.1f} mm", q * 1e3)
                                                   : fmt::format("{:.1f} deg", q / kOneDegree);
}

bool inside(const format::JointRow& row, double q) {
  return q >= row.q_min - kBeyond && q <= row.q_max + kBeyond;
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

}  // namespace

RowPlace row_place(const Measurements& measured, int row) {
  RowPlace out{0, row};
  while (out.table + 1 < static_cast<int>(measured.tables.size()) &&
         out.row >= measured.tables[out.table].rows())
    out.row -= measured.tables[out.table++].rows();
  return out;
}

namespace {

bool assumed(const Cell& cell, int joint) {
  const auto at = static_cast<std::size_t>(joint);
  return at < cell.assumed_limits.size() && cell.assumed_limits[at];
}

/// Nobody stated these limits: what goes beyond them is no error.
Problem beyond_assumed(const Cell& cell, const Measurements& measured, int joint) {
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

std::vector<Problem> limit_findings(const Cell& cell, const Measurements& measured) {
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
                     lines_of(measured, beyond),
                     turn ? "; a whole turn less or more would be inside" : ""),
         cell_of(measured, first, fmt::format("q{}", j + 1), shown(row, measured.q(first, j))),
         turn ? fmt::format("if {0} counts turns like this on the controller too, widen its limits "
                            "q in cell.toml; else take 360 deg off or add them in these rows",
                            row.name)
              : fmt::format("correct the rows, or in cell.toml the limits q of {}", row.name)});
  }
  return out;
}

namespace {

/// One pose again and again, or joint columns that stood still while the arm moved.
Problem equal_poses(const Measurements& measured) {
  const double spread =
      (measured.p_M.colwise().maxCoeff() - measured.p_M.colwise().minCoeff()).norm();
  const bool arm_moved = spread > kOnePlace;
  return {Severity::kError, "E-CHECK-EQUAL",
          arm_moved ? fmt::format(
                          "every row has the same joint positions, but the points are up to {:.3g} "
                          "mm apart: these are not the joint positions of these points",
                          spread * 1e3)
                    : "every row has the same joint positions",
          cell_of(measured, 0, "q1", arm_moved ? "the same in every row" : "the only pose"),
          arm_moved ? "export the joint positions again, each row at its own pose"
                    : "measure at least 30 poses all over the joint limits"};
}

}  // namespace

std::vector<Problem> copy_findings(const Measurements& measured) {
  std::vector<Problem> out;
  std::map<std::array<double, 3>, int> seen;
  std::vector<int> copies;
  int original = 0;
  bool moved = false;
  for (int i = 0; i < measured.size(); ++i) {
    moved = moved || measured.q.row(i) != measured.q.row(0);
    const std::array<double, 3> p{measured.p_M(i, 0), measured.p_M(i, 1), measured.p_M(i, 2)};
    const auto [at, is_new] = seen.emplace(p, i);
    if (is_new) continue;
    if (copies.empty()) original = at->second;
    copies.push_back(i);
  }
  if (!moved && measured.size() > 1) out.push_back(equal_poses(measured));
  if (copies.empty()) return out;
  const bool same_pose = measured.q.row(copies.front()) == measured.q.row(original);
  out.push_back(
      {Severity::kWarning, "W-CHECK-COPY",
       fmt::format("{} of {} readings repeat another one to the last digit, {}{}", copies.size(),
                   measured.size(), lines_of(measured, copies),
                   same_pose ? "" : ", at other joint positions"),
       cell_of(
           measured, copies.front(), measured.has_axis[0] ? "x" : "y",
           measured.tables.empty()
               ? ""
               : fmt::format("as in line {}", measured.tables[row_place(measured, original).table]
                                                  .lines[row_place(measured, original).row])),
       "delete the copies: a true repeat has its own reading, and copies hide the noise"});
  return out;
}

std::vector<Problem> outlier_findings(const Measurements& measured,
                                      const std::vector<Outlier>& outliers) {
  if (outliers.empty()) return {};
  std::vector<int> rows;
  for (const auto& outlier : outliers) rows.push_back(outlier.row);
  const Outlier& first = outliers.front();
  return {{Severity::kWarning, "W-CHECK-OUTLIER",
           fmt::format("{} {} by the others, {}: the farthest by {:.3g} mm, {:.0f} times the usual",
                       rows.size(),
                       rows.size() == 1 ? "reading is contradicted" : "readings are contradicted",
                       lines_of(measured, rows), first.error_m * 1e3, first.times),
           cell_of(measured, first.row, measured.has_axis[0] ? "x" : "y", "does not belong"),
           "measure these poses again, or mark the rows with set = ignore"}};
}

std::vector<Problem> constant_findings(const Cell& cell, const Measurements& measured) {
  std::vector<Problem> out;
  for (int j = 0; j < cell.joints(); ++j) {
    const auto q = measured.q.col(j);
    if (q.maxCoeff() - q.minCoeff() >= kStill) continue;
    out.push_back(
        {Severity::kWarning, "W-CHECK-STILL",
         fmt::format("{} never moves: it stays at {}", cell.nominal.joints[j].name,
                     shown(cell.nominal.joints[j], q(0))),
         cell_of(measured, 0, fmt::format("q{}", j + 1), "the same in every row"),
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

}  // namespace plumb::offline
