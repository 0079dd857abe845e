// SPDX-License-Identifier: Apache-2.0
#include "cell/unit_sense.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plumb::offline {
namespace {

constexpr double kLongestLink_m = 20.0;
constexpr double kMostTurn = 4.0 * M_PI;           // of a DH angle [rad]
constexpr double kMostTravel = 20.0 * M_PI;        // of a joint [rad]
constexpr double kLeastTravel = 7.0 / 180 * M_PI;  // 2 pi read as degrees is 6.3 degrees
constexpr double kNear = 1e-3;                     // pi/2 written with four digits or more

/// A number that is half pi, in a file in degrees.
bool is_radians_in_degrees(const toml::node& node) {
  const double value = std::abs(node.value<double>().value_or(0.0));
  return std::abs(value - M_PI_2) < kNear || std::abs(value - M_PI) < kNear;
}

void warn_of_angle(TomlTable& joint, const std::string& key, double si, const Cell& cell) {
  const toml::node* node = joint.node(key);
  if (node == nullptr) return;
  const bool degrees = cell.angle_unit == "deg";
  if (std::abs(si) <= kMostTurn && !(degrees && is_radians_in_degrees(*node))) return;
  joint.warning("W-CELL-ANGLE",
                fmt::format("'{}' looks like {}", joint.name(key), degrees ? "radians" : "degrees"),
                *node, fmt::format("read as {:.6g} turns", si / (2.0 * M_PI)),
                degrees ? "if so: angle_unit = \"rad\"" : "if so: angle_unit = \"deg\"");
}

void warn_of_length(TomlTable& joint, const std::string& key, double si) {
  const toml::node* node = joint.node(key);
  if (node == nullptr || std::abs(si) <= kLongestLink_m) return;
  joint.warning("W-CELL-LENGTH", fmt::format("'{}' is a link of {:.6g} m", joint.name(key), si),
                *node, "that long?", "check length_unit in [robot]");
}

void warn_of_limits(TomlTable& joint, const format::JointRow& row) {
  const toml::node* node = joint.node("q");
  if (node == nullptr || row.type == format::JointType::kPrismatic) return;
  const double most = std::max(std::abs(row.q_min), std::abs(row.q_max));
  if (most <= kMostTravel && most >= kLeastTravel) return;
  joint.warning("W-CELL-ANGLE",
                fmt::format("'{}' reaches {:.4g}°", joint.name("q"), most * 180.0 / M_PI), *node,
                "in the file's angle_unit?", "check angle_unit in [robot]");
}

}  // namespace

void warn_of_units(TomlTable& joint, const format::JointRow& row, const Cell& cell) {
  warn_of_angle(joint, "alpha", row.alpha, cell);
  warn_of_angle(joint, "theta", row.theta, cell);
  warn_of_length(joint, "a", row.a);
  warn_of_length(joint, "d", row.d);
  warn_of_limits(joint, row);
}

}  // namespace plumb::offline
