// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>

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

/// "J3 = q3 + q2": the value that the controller shows, as a sum of joint angles; and the key.
void coupling_words(std::vector<std::string>& out, const Cell& cell,
                    const std::vector<format::JointCoupling>& coupling) {
  if (coupling.empty())
    return out.emplace_back("the joint values are not coupled, as [robot] coupling says"), void();
  std::vector<std::string> pairs;
  for (const auto& [joint, by, ratio] : coupling)
    pairs.push_back(fmt::format("{} of {}, share {:g}", cell.nominal.joints[joint].name,
                                cell.nominal.joints[by].name, -ratio));
  const auto n = static_cast<std::size_t>(cell.joints());
  std::vector<std::string> sums;
  for (std::size_t i = 0; i < n; ++i) {
    std::string sum;
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<double> q(n, 0.0);  // of joint j's angle alone
      q[j] = 1.0;
      Coupling(coupling).to_values(q);
      if (i == j || q[i] == 0.0) continue;
      sum += fmt::format(" {} {}q{}", q[i] < 0.0 ? "-" : "+",
                         std::abs(q[i]) == 1.0 ? "" : fmt::format("{:g} ", std::abs(q[i])), j + 1);
    }
    if (!sum.empty())
      sums.push_back(fmt::format("{} = q{}{}", cell.nominal.joints[i].name, i + 1, sum));
  }
  out.push_back(fmt::format("the joint values are coupled: {} (coupling: {})",
                            fmt::join(sums, ", "), fmt::join(pairs, "; ")));
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
  if (meant.coupling != present.coupling) coupling_words(out, cell, meant.coupling);
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
