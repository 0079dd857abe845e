// SPDX-License-Identifier: Apache-2.0
#include "fit/cell_data.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plumb::offline {

std::vector<bool> joint_is_angle(const Cell& cell) {
  std::vector<bool> out;
  for (const auto& row : cell.nominal.joints)
    out.push_back(row.type == format::JointType::kRevolute);
  return out;
}

Measurements read_cell_measurements(const Cell& cell) {
  auto files = cell.measurement.files;
  if (cell.measurement.held_out.kind == HeldOutRule::Kind::kFile)
    files.push_back(cell.measurement.held_out.file);
  Measurements out = read_measurements(files, joint_is_angle(cell), Needs::kJointsAndPosition);
  check_rows(cell, out);
  return out;
}

void check_rows(const Cell& cell, const Measurements& measured) {
  std::vector<Problem> problems;
  for (const auto& effect : cell.effects) {
    const auto it = effect.options.find("after_row");
    const auto* row = it == effect.options.end() ? nullptr : std::get_if<double>(&it->second);
    if (row == nullptr || *row < measured.size()) continue;
    problems.push_back(
        {.code = "E-EFFECT-DATA",
         .message = fmt::format("effect '{}' begins behind row {:g}, but the last of "
                                "the measurements is row {}",
                                effect.name, *row, measured.size()),
         .place = effect.place,
         .help = fmt::format("after_row = {}   # or less", std::max(1, measured.size() - 1))});
  }
  if (!problems.empty()) throw Failure(Exit::kInput, std::move(problems));
}

}  // namespace plumb::offline
