// SPDX-License-Identifier: Apache-2.0
#include "import/headerless.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "import/cells.hpp"
#include "import/content.hpp"
#include "import/joint_states.hpp"
#include "import/number_text.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kAxes = 3, kArmJoints = 4, kMostJoints = 7;

bool holds_numbers(const CellTable& rows, std::size_t column) {
  const auto is_measured = [&](std::string_view cell) { return is_number(cell) && !is_time(cell); };
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!is_measured(rows[i][column])) return false;
  return true;
}

double largest_of(const CellTable& rows, std::size_t first, std::size_t end) {
  double out = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = first; k < end; ++k)
      if (const auto value = number_in(rows[i][k], '.')) out = std::max(out, std::abs(*value));
  return out;
}

/// "A::robot::p1" in every row.
bool are_collection_names(const CellTable& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i][0].find("::") == std::string_view::npos) return false;
  return true;
}

/// A --header for the columns in their most usual order: a name, joints, a point. Columns that
/// have no place in it are called c1, c2, ...
std::string proposed(const CellTable& rows) {
  const std::size_t size = rows[0].size();
  std::vector<std::string> names;
  std::size_t first = 0;
  while (first < size && !holds_numbers(rows, first)) ++first;
  for (std::size_t k = 0; k < first; ++k)
    names.push_back(k == 0 ? "pose" : fmt::format("c{}", k + 1));
  std::size_t end = first;
  while (end < size && holds_numbers(rows, end)) ++end;
  const std::size_t numbers = end - first;
  const bool joints_too = numbers >= kArmJoints + kAxes;
  const std::size_t joints = joints_too              ? std::min(numbers - kAxes, kMostJoints)
                             : numbers >= kArmJoints ? numbers
                                                     : 0;
  const auto unit = [&](const char* name, std::size_t from, std::size_t to) {
    return unit_choice(name, largest_of(rows, from, to)).text();
  };
  for (std::size_t j = 0; j < joints; ++j)
    names.push_back(fmt::format("q{}_{}", j + 1, unit("q1", first, first + joints)));
  const std::size_t point = first + joints;
  for (std::size_t k = 0; k < kAxes && point + kAxes <= end; ++k)
    names.push_back(fmt::format("{}_{}", "xyz"[k], unit("x", point, point + kAxes)));
  while (names.size() < size) names.push_back(fmt::format("c{}", names.size() + 1));
  return fmt::format("{}", fmt::join(names, ","));
}

}  // namespace

std::vector<std::string> names_without_header(const SourceText& text, int line,
                                              const CellTable& rows,
                                              std::vector<Problem>& remarks) {
  const std::size_t size = rows[0].size();
  const bool point = size == 1 + kAxes && holds_numbers(rows, 1) && holds_numbers(rows, 2) &&
                     holds_numbers(rows, 3);
  if (point && are_collection_names(rows)) {
    remarks.push_back({.severity = Severity::kNote,
                       .code = "N-IMPORT-NAMED",
                       .message = "the file has no header; names with '::' and three numbers are "
                                  "taken as points of SpatialAnalyzer: pose, x, y, z",
                       .place = Place{.file = text.file, .line = line},
                       .help = "if they are something else: --header \"pose,...\""});
    return {"pose", "x", "y", "z"};
  }
  if (auto states = joint_state_header(rows)) {
    remarks.push_back({.severity = Severity::kNote,
                       .code = "N-IMPORT-NAMED",
                       .message = "the file has no header; its rows are those that ros2 topic echo "
                                  "--csv writes of joint states",
                       .place = Place{.file = text.file, .line = line},
                       .help = "if they are something else: --header \"pose,...\""});
    return *states;
  }
  const std::string names = proposed(rows);
  throw Failure(
      Exit::kInput,
      {.code = "E-IMPORT-HEADER",
       .message = fmt::format("the file has no header: {} columns without a name", size),
       .place = Place{.file = text.file,
                      .line = line,
                      .column = 1,
                      .source = std::string(text.lines[static_cast<std::size_t>(line) - 1]),
                      .label = "numbers begin here"},
       .help = fmt::format(
           "name them; if this is their order: --header \"{}\"{}", names,
           names.find('|') == names.npos ? "" : "  (keep one of the units that | divides)")});
}

}  // namespace plumb::offline
