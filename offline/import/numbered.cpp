// SPDX-License-Identifier: Apache-2.0
#include "import/numbered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace plumb::offline {
namespace {

constexpr double kUnitLength =
    2e-3;  // error of the sum of squares of a quaternion with four digits
constexpr const char* kScalarFirst[] = {"qw", "qx", "qy", "qz"};
constexpr const char* kScalarLast[] = {"qx", "qy", "qz", "qw"};

using Group = std::map<int, std::size_t>;  // number -> column

std::string names_of(const Group& group, const std::vector<ColumnPlan>& plans) {
  return fmt::format("{} to {}", plans[group.begin()->second].from,
                     plans[group.rbegin()->second].from);
}

/// Squares of the columns, added up row by row; nothing if one holds texts.
std::vector<double> squares(const Group& group, const std::vector<ColumnContent>& contents) {
  std::vector<double> out;
  for (const auto& [number, column] : group) {
    const auto& values = contents[column].numbers;
    if (values.empty()) return {};
    out.resize(values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) out[i] += values[i] * values[i];
  }
  return out;
}

bool all_of_unit_length(const std::vector<double>& squares) {
  return !squares.empty() && std::all_of(squares.begin(), squares.end(),
                                         [](double s) { return std::abs(s - 1.0) < kUnitLength; });
}

bool none_longer_than_1(const std::vector<double>& squares) {
  return !squares.empty() && std::all_of(squares.begin(), squares.end(),
                                         [](double s) { return s < 1.0 + kUnitLength; });
}

std::string map_of(const Group& group, const std::vector<ColumnPlan>& plans,
                   const char* const (&names)[4]) {
  std::vector<std::string> out;
  std::size_t k = 0;
  for (const auto& [number, column] : group)
    out.push_back(fmt::format("{}={}", plans[column].from, names[k++]));
  return fmt::format("--map \"{}\"", fmt::join(out, ","));
}

void leave_out(const Group& group, std::vector<ColumnPlan>& plans) {
  for (const auto& [number, column] : group) {
    plans[column].name.clear();
    plans[column].lacks_unit = false;
  }
}

void decide_quaternion(const Group& group, std::vector<ColumnPlan>& plans,
                       std::vector<Problem>& remarks) {
  if (group.begin()->first == 0) {
    std::size_t k = 0;
    for (const auto& [number, column] : group) {
      plans[column].name = kScalarFirst[k++];
      plans[column].lacks_unit = false;
    }
    remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-IMPORT-QUAT",
         .message = fmt::format("{} are a quaternion: their squares add up to 1; {} "
                                "was taken as its scalar part",
                                names_of(group, plans), plans[group.begin()->second].from),
         .help = "if the scalar comes last: " + map_of(group, plans, kScalarLast)});
    return;
  }
  remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-IMPORT-QUAT",
       .message =
           fmt::format("{} are a quaternion, as their squares add up to 1, but which of them "
                       "is the scalar part cannot be told: left out",
                       names_of(group, plans)),
       .help = fmt::format("scalar first: {}; scalar last: {}", map_of(group, plans, kScalarFirst),
                           map_of(group, plans, kScalarLast))});
  leave_out(group, plans);
}

bool has_other_joints(const std::string& stem, const std::vector<ColumnPlan>& plans) {
  return std::any_of(plans.begin(), plans.end(), [&](const ColumnPlan& plan) {
    return plan.name == "q1" && plan.named.stem != stem;
  });
}

void count_from_one(const Group& group, std::vector<ColumnPlan>& plans,
                    std::vector<Problem>& remarks) {
  for (const auto& [number, column] : group) {
    auto& name = plans[column].name;
    name = (name.starts_with("qc") ? "qc" : "q") + std::to_string(number + 1);
    plans[column].lacks_unit = plans[column].unit.empty() && plans[column].foreign.empty();
  }
  remarks.push_back({.severity = Severity::kNote,
                     .code = "N-IMPORT-ZERO",
                     .message = fmt::format(
                         "{} count the joints from 0: they became {} to {}", names_of(group, plans),
                         plans[group.begin()->second].name, plans[group.rbegin()->second].name),
                     .help = "--map says otherwise"});
}

}  // namespace

void decide_numbered(const std::vector<ColumnContent>& contents, std::vector<ColumnPlan>& plans,
                     std::vector<Problem>& remarks) {
  std::map<std::string, Group> groups;
  for (std::size_t i = 0; i < plans.size(); ++i)
    if (!plans[i].wished && plans[i].named.number >= 0 &&
        (plans[i].named.quaternion_part || !plans[i].name.empty()))
      groups[plans[i].named.stem].emplace(plans[i].named.number, i);
  for (const auto& [stem, group] : groups) {
    const auto& first = plans[group.begin()->second].named;
    const bool without_unit = std::all_of(group.begin(), group.end(), [&](const auto& entry) {
      return plans[entry.second].unit.empty() && plans[entry.second].foreign.empty();
    });
    const int low = group.begin()->first, high = group.rbegin()->first;
    const bool whole = high - low + 1 == static_cast<int>(group.size()) && low <= 1;
    if ((first.quaternion_part || first.letter_q) && without_unit && whole) {
      const auto sums = squares(group, contents);
      if (group.size() == 4 && all_of_unit_length(sums)) {
        decide_quaternion(group, plans, remarks);
        continue;
      }
      if (group.size() == 3 && low == 1 && none_longer_than_1(sums) &&
          has_other_joints(stem, plans)) {
        remarks.push_back(
            {.severity = Severity::kWarning,
             .code = "W-IMPORT-QUAT",
             .message = fmt::format("{} are no joints, as these stand beside them; as parts of a "
                                    "quaternion they lack the scalar: left out",
                                    names_of(group, plans)),
             .help = "export the scalar part of the quaternion too"});
        leave_out(group, plans);
        continue;
      }
    }
    if (low == 0 && !first.quaternion_part) count_from_one(group, plans, remarks);
  }
}

}  // namespace plumb::offline
