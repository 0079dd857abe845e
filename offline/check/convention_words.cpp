// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "check/convention.hpp"

namespace plumb::offline {
namespace {

const char* name_of(format::Convention dh) {
  return dh == format::Convention::kStandard ? "standard" : "modified";
}

const char* words_of(Mirror mirror) {
  switch (mirror) {
    case Mirror::kNegateX:
      return "the measured points are left-handed, x has the wrong sign";
    case Mirror::kNegateY:
      return "the measured points are left-handed";
    case Mirror::kNegateZ:
      return "the measured points are left-handed, z has the wrong sign";
    case Mirror::kSwapXY:
      return "the measured points are left-handed, x and y are swapped";
    case Mirror::kSwapYZ:
      return "the measured points are left-handed, y and z are swapped";
    case Mirror::kSwapXZ:
      return "the measured points are left-handed, x and z are swapped";
    default:
      return "";
  }
}

void unit_words(std::vector<std::string>& out, const char* what, const std::string& now,
                const std::string& meant) {
  if (now != meant) out.push_back(fmt::format("{} are in {}, not {}", what, meant, now));
}

void reversed_words(std::vector<std::string>& out, const Cell& cell,
                    const std::vector<bool>& reversed) {
  std::vector<std::string> names;
  for (int j = 0; j < cell.joints(); ++j)
    if (reversed[j]) names.push_back(cell.nominal.joints[j].name);
  if (!names.empty())
    out.push_back(fmt::format("{} {} the other way", fmt::join(names, ", "),
                              names.size() == 1 ? "counts" : "count"));
}

void order_words(std::vector<std::string>& out, const Cell& cell, const std::vector<int>& column) {
  std::vector<std::string> held, joints;
  for (std::size_t j = 0; j < column.size(); ++j) {
    const auto holds =
        std::find(column.begin(), column.end(), static_cast<int>(j)) - column.begin();
    if (holds == static_cast<std::ptrdiff_t>(j)) continue;
    held.push_back(fmt::format("q{}", j + 1));
    joints.push_back(cell.nominal.joints[static_cast<std::size_t>(holds)].name);
  }
  if (held.size() == 2)
    out.push_back(fmt::format("columns {} and {} are swapped", held[0], held[1]));
  else if (!held.empty())
    out.push_back(
        fmt::format("columns {} hold {}", fmt::join(held, ", "), fmt::join(joints, ", ")));
}

/// "1/101" of a gear, "2", "1.2346".
std::string factor_words(double factor) {
  const double turns = 1.0 / std::abs(factor);
  if (std::abs(factor) < 0.99 && std::abs(turns - std::round(turns)) < 1e-9)
    return fmt::format("{}1/{:.0f}", factor < 0.0 ? "-" : "", turns);
  return fmt::format("{:.6g}", factor);
}

void joint_words(std::vector<std::string>& out, const Cell& cell, const Convention& present,
                 const Convention& meant, std::size_t j) {
  const std::string& name = cell.nominal.joints[j].name;
  if (meant.zero[j] != present.zero[j])
    out.push_back(
        fmt::format("the zero of {} is not that of the DH table: its offset is {:+.4g} deg", name,
                    (cell.nominal.joints[j].offset + meant.zero[j]) * 180.0 / M_PI));
  if (meant.own_unit[j] != present.own_unit[j])
    out.push_back(fmt::format("column q{} ({}) alone is in {}, not {}", j + 1, name,
                              meant.own_unit[j], present.turn_unit));
  if (meant.factor[j] != present.factor[j])
    out.push_back(fmt::format(
        "column q{} ({}) counts otherwise, its numbers are to be multiplied by {} (are they of the "
        "motor and not of the link?)",
        j + 1, name, factor_words(meant.factor[j])));
}

}  // namespace

std::vector<std::string> in_words(const Cell& cell, const Convention& present,
                                  const Convention& meant) {
  std::vector<std::string> out;
  if (meant.dh != present.dh)
    out.push_back(fmt::format("the DH table is in the {} convention, not the {} one",
                              name_of(meant.dh), name_of(present.dh)));
  unit_words(out, "the lengths of the DH table", present.length_unit, meant.length_unit);
  unit_words(out, "the angles of the DH table", present.angle_unit, meant.angle_unit);
  unit_words(out, "the joint angles of the measurements", present.turn_unit, meant.turn_unit);
  unit_words(out, "the sliding joints of the measurements", present.slide_unit, meant.slide_unit);
  unit_words(out, "the measured points", present.point_unit, meant.point_unit);
  order_words(out, cell, meant.column);
  reversed_words(out, cell, meant.reversed);
  for (int j = 0; j < cell.joints(); ++j) {
    const auto& name = cell.nominal.joints[j].name;
    if (meant.quarter_turns[j] != 0)
      out.push_back(
          fmt::format("the zero of {} is turned by {:+} deg", name, 90 * meant.quarter_turns[j]));
  }
  for (std::size_t j = 0; j < meant.zero.size(); ++j) joint_words(out, cell, present, meant, j);
  if (meant.mirror != Mirror::kNone) out.emplace_back(words_of(meant.mirror));
  if (meant.frame_inverted)
    out.emplace_back(
        "the given frame is that of the tracker in the base, not of the base in the "
        "tracker");
  return out;
}

}  // namespace plumb::offline
