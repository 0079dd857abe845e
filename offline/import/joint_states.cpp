// SPDX-License-Identifier: Apache-2.0
#include "import/joint_states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "import/cells.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kFewestNamed = 2;

bool is_text(std::string_view cell) { return !cell.empty() && !is_number(cell) && !is_time(cell); }

/// The text of a column that holds the same in every row; empty if it does not.
std::string constant(const CellTable& rows, std::size_t column) {
  const auto first = rows[0][column];
  if (!is_text(first)) return {};
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i][column] != first) return {};
  return std::string(first);
}

std::optional<std::size_t> column_of(const RawRows& rows, const std::string& name) {
  const auto& header = rows.dialect.header;
  const auto at = std::find(header.begin(), header.end(), name);
  if (at == header.end()) return std::nullopt;
  return static_cast<std::size_t>(at - header.begin());
}

/// The name of the positions to a column of names: "field.name0", "joint_states.name[0]".
std::string position_beside(const std::string& header) {
  const auto at = header.rfind("name");
  if (at == header.npos) return {};
  const auto behind = header.substr(at + 4);
  const bool numbered = std::any_of(behind.begin(), behind.end(),
                                    [](unsigned char c) { return std::isdigit(c) != 0; }) &&
                        std::none_of(behind.begin(), behind.end(),
                                     [](unsigned char c) { return std::isalpha(c) != 0; });
  return numbered ? header.substr(0, at) + "position" + behind : std::string();
}

}  // namespace

std::optional<std::vector<std::string>> joint_state_header(const CellTable& rows) {
  const std::size_t size = rows[0].size();
  std::size_t first = 0;
  const auto run_from = [&](std::size_t at) {
    std::size_t end = at;
    while (end < size && !constant(rows, end).empty()) ++end;
    return end - at;
  };
  while (first < size && run_from(first) < kFewestNamed) ++first;
  if (first == size) return std::nullopt;
  const std::size_t joints = run_from(first), behind = size - first - joints;
  if (behind == 0 || behind % joints != 0 || behind / joints > 3) return std::nullopt;
  for (std::size_t k = first + joints; k < size; ++k)
    if (!is_number(rows[0][k])) return std::nullopt;
  std::vector<std::string> out;
  for (std::size_t k = 0; k < first; ++k) out.push_back(fmt::format("c{}", k + 1));
  if (first >= 2 && is_number(rows[0][0]) && is_number(rows[0][1]))
    out[0] = "stamp.sec", out[1] = "stamp.nanosec";
  for (const char* name : {"name", "position", "velocity", "effort"})
    for (std::size_t j = 0; j < joints && out.size() < size; ++j)
      out.push_back(fmt::format("{}{}", name, j));
  return out;
}

void name_joint_states(const SourceText& text, RawRows& rows) {
  std::vector<std::string> joints;
  for (std::size_t k = 0; k < rows.dialect.header.size(); ++k) {
    const auto position = column_of(rows, position_beside(rows.dialect.header[k]));
    const std::string joint = position ? constant(rows.cells, k) : "";
    if (joint.empty()) continue;
    rows.dialect.header[*position] = joint + " [rad]";
    joints.push_back(joint);
  }
  if (joints.empty()) return;
  rows.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-IMPORT-STATES",
       .message = fmt::format("these are joint states of ROS: the positions belong to {}, in rad",
                              fmt::join(joints, ", ")),
       .place = Place{.file = text.file, .line = std::max(1, rows.dialect.header_line)},
       .help = "--map says otherwise"});
}

}  // namespace plumb::offline
