// SPDX-License-Identifier: Apache-2.0
#include "cell/touched_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "cell/table_place.hpp"
#include "program/problem_list.hpp"

namespace plumb::offline {
namespace {

constexpr const char* kPointCode = "E-CSV-POINT";

/// Two statements of one distance that differ by more than this contradict each other [m].
constexpr double kSameLength_m = 1e-6;

const Column* text_column(const Table& table, const char* name) {
  const Column* column = table.find(name);
  return column != nullptr && column->quantity == Quantity::kText ? column : nullptr;
}

/// Lists points and distances in the order in which rows name them.
class PointList {
 public:
  PointList(MeasurementSettings& settings, ProblemList& problems)
      : m_(settings), problems_(problems) {}

  void read(const Table& table) {
    const Column& label = *text_column(table, "point");
    const Column* position = text_column(table, "position");
    int without = 0;
    for (int row = 0; row < table.rows(); ++row)
      if (label.text[row].empty() && without++ == 0)
        problems_.error(kPointCode, "this row does not say which point it touches",
                        place_in_row(table, row, label, "empty"),
                        "write the label of the point, or delete the row");
      else
        point(label.text[row], position == nullptr ? "" : position->text[row]);
  }

  /// After all points are listed.
  void read_lengths(const Table& table) {
    const Column* to = text_column(table, "to_point");
    const Column* distance = table.find("distance");
    if (to == nullptr || distance == nullptr) return one_without_the_other(table, to, distance);
    const Column& from = *text_column(table, "point");
    for (int row = 0; row < table.rows(); ++row)
      if (!to->text[row].empty()) length(table, row, from.text[row], *to, *distance);
  }

 private:
  void point(const std::string& label, const std::string& position) {
    if (!label.empty() && index_.emplace(label, static_cast<int>(m_.setups.size())).second) {
      Setup setup;
      setup.name = label;
      setup.is_point = true;
      setup.position = position;
      setup.fit_target = m_.fit_target || !m_.setups.empty();
      setup.target_T = m_.target_T;
      if (first_ < 0)
        first_ = static_cast<int>(m_.setups.size());
      else
        setup.target_of = first_;
      m_.setups.push_back(std::move(setup));
    }
  }

  void one_without_the_other(const Table& table, const Column* to, const Column* distance) {
    const Column* alone = to != nullptr ? to : distance;
    if (alone == nullptr) return;
    problems_.error(kPointCode,
                    fmt::format("column '{}' is of no use alone: a known distance between two "
                                "points needs 'to_point' and 'distance_mm'",
                                alone->header),
                    place_in_header(table, *alone, "the other one is missing"),
                    "add the other column, or delete this one");
  }

  void length(const Table& table, int row, const std::string& from, const Column& to,
              const Column& distance) {
    const std::string& other = to.text[row];
    const auto end = index_.find(other);
    if (end == index_.end() || other == from)
      return problems_.error(kPointCode,
                             end == index_.end()
                                 ? fmt::format("no row touches the point '{}'", other)
                                 : fmt::format("'{}' is the point of this row itself", other),
                             place_in_row(table, row, to, "no other point"),
                             "write the label of another point that rows touch");
    const double length_m = distance.values[row];
    if (!(length_m > 0.0))
      return problems_.error(kPointCode, "the distance of two points is greater than 0",
                             place_in_row(table, row, distance, "not greater than 0"),
                             "write the distance between the two points");
    const int a = index_.at(from), b = end->second;
    const auto [known, is_new] = lengths_.emplace(std::minmax(a, b), length_m);
    if (is_new)
      m_.lengths.push_back({a, b, length_m});
    else if (std::abs(known->second - length_m) > kSameLength_m)
      problems_.error(
          kPointCode,
          fmt::format("'{}' and '{}' are {:g} mm apart here and {:g} mm in a row before", from,
                      other, length_m * 1e3, known->second * 1e3),
          place_in_row(table, row, distance, "contradicts it"), "correct one of them");
  }

  MeasurementSettings& m_;
  ProblemList& problems_;
  std::map<std::string, int> index_;
  std::map<std::pair<int, int>, double> lengths_;
  int first_ = -1;
};

}  // namespace

bool touches(const Table& table) {
  const auto has = [&](const char* axis) { return table.find(axis) != nullptr; };
  const Column* label = text_column(table, "point");
  if (label == nullptr || has("x") || has("y") || has("z")) return false;
  return std::set<std::string_view>(label->text.begin(), label->text.end()).size() <
         label->text.size();
}

void list_touched_points(const std::vector<Table>& tables, MeasurementSettings& m) {
  std::erase_if(m.setups, [](const Setup& s) { return s.is_point; });  // of an earlier reading
  m.lengths.clear();
  const std::ptrdiff_t touching = std::count_if(tables.begin(), tables.end(), touches);
  if (touching == 0) return;
  if (m.setups.empty() && touching < static_cast<std::ptrdiff_t>(tables.size())) {
    Setup tracker;
    tracker.name = "measured positions";
    tracker.fit_frame = m.fit_frame;
    tracker.X_MB = m.X_MB;
    tracker.fit_target = m.fit_target;
    tracker.target_T = m.target_T;
    m.setups.push_back(std::move(tracker));
  }
  ProblemList problems;
  PointList list(m, problems);
  for (const auto& table : tables)
    if (touches(table)) list.read(table);
  for (const auto& table : tables)
    if (touches(table)) list.read_lengths(table);
  problems.stop_on_errors();
}

namespace {

void ignore_single_touches(const MeasurementSettings& m, MeasurementFiles& measured) {
  std::map<int, std::vector<int>> rows;
  for (int i = 0; i < measured.size(); ++i)
    if (measured.touches_point(i) && measured.set[static_cast<std::size_t>(i)] != SetMark::kIgnore)
      rows[measured.setup[static_cast<std::size_t>(i)]].push_back(i);
  std::vector<std::string> names;
  for (const auto& [setup, of_point] : rows) {
    if (of_point.size() > 1) continue;
    measured.set[static_cast<std::size_t>(of_point.front())] = SetMark::kIgnore;
    names.push_back(m.setups[static_cast<std::size_t>(setup)].name);
  }
  if (names.empty()) return;
  auto& table = *std::find_if(measured.tables.begin(), measured.tables.end(), touches);
  table.remarks.push_back(
      {Severity::kWarning, "W-CSV-POINT",
       fmt::format("a point that is touched only once says nothing, and its row is not used: {}",
                   fmt::join(names, ", ")),
       place_in_header(table, *text_column(table, "point"), "labels of the points"),
       "give rows of one point the same label, or touch it again from other directions"});
}

}  // namespace

void assign_placements(const MeasurementSettings& settings, MeasurementFiles& measured) {
  if (std::none_of(measured.tables.begin(), measured.tables.end(), touches)) return;
  measured.placement.clear();
  std::map<std::string, int> number;
  for (const auto& table : measured.tables) {
    const bool touched = touches(table);
    const Column* position = text_column(table, "position");
    for (int row = 0; row < table.rows(); ++row) {
      if (!touched) {
        measured.placement.push_back(-1);
        continue;
      }
      const bool placed = position != nullptr && !position->text[row].empty();
      const std::string key = placed ? "position " + position->text[row]
                                     : "point " + text_column(table, "point")->text[row];
      measured.placement.push_back(
          number.emplace(key, static_cast<int>(number.size())).first->second);
    }
  }
  ignore_single_touches(settings, measured);
}

bool lacks_length(const Cell& cell) {
  const MeasurementSettings& m = cell.measurement;
  const auto slides = [](const format::JointRow& row) {
    return row.type == format::JointType::kPrismatic;
  };
  return std::none_of(cell.nominal.joints.begin(), cell.nominal.joints.end(), slides) &&
         !m.setups.empty() && m.lengths.empty() &&
         std::all_of(m.setups.begin(), m.setups.end(), [](const Setup& s) { return s.is_point; });
}

}  // namespace plumb::offline
