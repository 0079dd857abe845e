// SPDX-License-Identifier: Apache-2.0
#include "check/faulty_run.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>

#include "cell/table_place.hpp"

namespace plumb::offline {
namespace {

/// Headings of those of the named columns that the file has.
std::string headings(const Table& table, const std::vector<std::string>& names) {
  std::vector<std::string> out;
  for (const auto& name : names)
    if (const Column* column = table.find(name)) out.push_back(column->header);
  return fmt::format("{}", fmt::join(out, ", "));
}

std::string unit_of_column(const Table& table, const std::vector<std::string>& names,
                           const char* usual) {
  for (const auto& name : names)
    if (const Column* column = table.find(name)) return column->unit;
  return usual;
}

/// Names of all columns that one reading of the instrument may fill.
const std::vector<std::string>& reading_names() {
  static const std::vector<std::string> names{"x",  "y",  "z",  "qw", "qx", "qy", "qz",
                                              "rx", "ry", "rz", "sx", "sy", "sz"};
  return names;
}

const std::vector<std::string>& point_names() {
  static const std::vector<std::string> names{"x", "y", "z"};
  return names;
}

std::vector<std::string> turning_names(const Cell& cell) {
  std::vector<std::string> out;
  for (int j = 0; j < cell.joints(); ++j)
    if (cell.nominal.joints[static_cast<std::size_t>(j)].type == format::JointType::kRevolute)
      out.push_back(fmt::format("q{}", j + 1));
  return out;
}

std::string what_is_wrong(const Cell& cell, const RowFault& fault) {
  switch (fault.kind) {
    case RowFault::Kind::kSign:
      return fmt::format("{} counts the other way than in the other rows",
                         cell.nominal.joints[static_cast<std::size_t>(fault.joint)].name);
    case RowFault::Kind::kTurnUnit:
      return fmt::format("the joint angles are in {}, not in {} as their headings say", fault.is,
                         fault.says);
    case RowFault::Kind::kPointUnit:
      return fmt::format("the measured points are in {}, not in {} as their headings say", fault.is,
                         fault.says);
    case RowFault::Kind::kShift:
      break;
  }
  return fmt::format("each measured point belongs to the joint positions {} {}",
                     std::abs(fault.shift) == 1 ? "one row" : "two rows",
                     fault.shift < 0 ? "above" : "below");
}

std::string how_to_mend(const Cell& cell, const Table& table, const RowFault& fault,
                        const std::string& lines) {
  const std::string points = headings(table, point_names());
  switch (fault.kind) {
    case RowFault::Kind::kSign:
      return fmt::format("change the sign of {} in {}",
                         headings(table, {fmt::format("q{}", fault.joint + 1)}), lines);
    case RowFault::Kind::kTurnUnit:
      return fmt::format("multiply {} by {:.9g} in {}", headings(table, turning_names(cell)),
                         fault.factor, lines);
    case RowFault::Kind::kPointUnit:
      return fmt::format("multiply {} by {:.9g} in {}", points, fault.factor, lines);
    case RowFault::Kind::kShift:
      break;
  }
  return fmt::format("move {} of {} {} by {}, and delete the rows that are left without a point",
                     headings(table, reading_names()), lines, fault.shift < 0 ? "up" : "down",
                     std::abs(fault.shift) == 1 ? "one row" : "two rows");
}

}  // namespace

std::string unit_of_points(const Table& table) {
  return unit_of_column(table, point_names(), "mm");
}

std::string unit_of_turns(const Cell& cell, const Table& table) {
  return unit_of_column(table, turning_names(cell), "deg");
}

Problem row_fault_finding(const Cell& cell, const Table& table, const std::vector<int>& places,
                          const FaultyRun& run) {
  const int first = places[static_cast<std::size_t>(run.first)];
  const int last = places[static_cast<std::size_t>(run.last)];
  const std::string lines =
      fmt::format("lines {} to {}", table.lines[static_cast<std::size_t>(first)],
                  table.lines[static_cast<std::size_t>(last)]);
  const bool all = run.count() + std::abs(run.fault.shift) >= static_cast<int>(places.size());
  const std::string name =
      run.fault.kind == RowFault::Kind::kSign       ? fmt::format("q{}", run.fault.joint + 1)
      : run.fault.kind == RowFault::Kind::kTurnUnit ? turning_names(cell).front()
      : table.find("x") != nullptr                  ? "x"
                                                    : "y";
  const Column* column = table.find(name);
  return {Severity::kWarning, "W-CHECK-ROWS",
          fmt::format("in {} {}: repaired, these {} rows miss the arm by {:.2g} mm instead of "
                      "{:.3g} mm (medians){}",
                      lines, what_is_wrong(cell, run.fault), run.count(), run.after * 1e3,
                      run.before * 1e3,
                      all ? "" : fmt::format(", and the others by {:.2g} mm", run.others * 1e3)),
          column != nullptr
              ? std::optional<Place>(place_in_row(table, first, *column, "from here on"))
              : std::nullopt,
          how_to_mend(cell, table, run.fault, lines)};
}

}  // namespace plumb::offline
