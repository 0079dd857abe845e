// SPDX-License-Identifier: Apache-2.0
#include "cell/context_columns.hpp"

#include <fmt/format.h>

#include "cell/column_names.hpp"
#include "cell/iso_time.hpp"
#include "cell/table_place.hpp"

namespace plumb::offline {
namespace {

constexpr double kAbsoluteZero_degC = -273.15;

class ContextCheck {
 public:
  ContextCheck(const Table& table, const std::vector<bool>& joint_is_angle, ProblemList& problems)
      : table_(table), is_angle_(joint_is_angle), problems_(problems) {}

  void check(const Column& column) {
    const int direction = joint_number(column.header, "dir_j");
    const int travel = joint_number(column.name, "travel_j");
    if (direction > 0) {
      of_a_joint(column, direction);
      each(
          column, [](double d) { return d == 1.0 || d == -1.0 || d == 0.0; },
          "a direction is 1, -1 or 0", "write 1, -1 or 0 (not known)");
    } else if (travel > 0) {
      if (of_a_joint(column, travel)) of_its_kind(column, travel);
      each(
          column, [](double size) { return size >= 0.0; }, "a travel is a size, 0 or more",
          fmt::format("write the size; the sign stands in dir_j{}", travel));
    } else if (column.name == "payload") {
      each(
          column, [](double mass) { return mass >= 0.0; }, "a mass is 0 or more",
          "correct it, or delete the row");
    } else if (column.quantity == Quantity::kTemperature) {
      each(
          column, [](double t) { return t >= kAbsoluteZero_degC; }, "below absolute zero",
          "correct it, or delete the column");
    } else if (column.header == "time") {
      times(column);
    }
  }

 private:
  bool of_a_joint(const Column& column, int joint) {
    const int joints = static_cast<int>(is_angle_.size());
    if (joint <= joints) return true;
    problems_.error("E-CSV-JOINT",
                    fmt::format("column '{}', but the arm has {} joints", column.header, joints),
                    place_in_header(table_, column, "no such joint"),
                    "delete the column, or complete [robot] joints in cell.toml");
    return false;
  }

  void of_its_kind(const Column& column, int joint) {
    const bool turns = is_angle_[static_cast<std::size_t>(joint) - 1];
    if (column.quantity == (turns ? Quantity::kAngle : Quantity::kLength)) return;
    problems_.error("E-CSV-KIND",
                    fmt::format("column '{}' is {}, but joint {} {}", column.header,
                                kind_name(column.quantity), joint, turns ? "turns" : "slides"),
                    place_in_header(table_, column, "wrong kind of unit"),
                    fmt::format("rename it to 'travel_j{}_{}' if the numbers are", joint,
                                turns ? "deg" : "mm"));
  }

  void each(const Column& column, bool (*can_be)(double), const char* rule,
            const std::string& help) {
    for (int row = 0; row < table_.rows() && !problems_.full(); ++row)
      if (!can_be(column.values[row]))
        problems_.error("E-CSV-CONTEXT", fmt::format("column '{}': {}", column.header, rule),
                        place_in_row(table_, row, column, "cannot be"), help);
  }

  void times(const Column& column) {
    for (int row = 0; row < table_.rows() && !problems_.full(); ++row)
      if (!iso_seconds(column.text[row]))
        problems_.error(
            "E-CSV-TIME",
            fmt::format("column 'time': '{}' is not a date and time of ISO 8601", column.text[row]),
            place_in_row(table_, row, column, "not like 2026-03-01T12:30:00"),
            "write 2026-03-01T12:30:00, or give seconds in a column 't_s'");
  }

  const Table& table_;
  const std::vector<bool>& is_angle_;
  ProblemList& problems_;
};

}  // namespace

void check_context_columns(const Table& table, const std::vector<bool>& joint_is_angle,
                           ProblemList& problems) {
  ContextCheck check(table, joint_is_angle, problems);
  for (const auto& column : table.columns) check.check(column);
}

}  // namespace plumb::offline
