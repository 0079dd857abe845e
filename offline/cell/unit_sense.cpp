// SPDX-License-Identifier: Apache-2.0
#include "cell/unit_sense.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plumb::offline {
namespace {

constexpr double kLongestLink_m = 20.0;
/// No DH angle and no limit of a joint is larger [rad].
constexpr double kMostTurn = 4.0 * M_PI, kMostTravel = 20.0 * M_PI;
/// Smaller limits [rad] probably are in radians: 2 pi read as degrees is 6.3 degrees.
constexpr double kLeastTravel = 7.0 / 180 * M_PI;
/// Distance from pi/2 of a number that is written with four digits or more.
constexpr double kNear = 1e-3;

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

/// Gravity on the Earth's surface [m/s^2] lies between 9.78 and 9.83.
constexpr double kStandard = 9.81, kNearGravity = 0.05;
constexpr double kHeaviestLink_kg = 5000.0;

/// What a length of the vector looks like in another unit.
const char* unit_of_gravity(double size) {
  const auto is = [size](double other) { return std::abs(size / other - 1.0) < 0.01; };
  if (is(kStandard * 1e3)) return "that is mm/s^2";
  if (is(kStandard * 1e2)) return "that is cm/s^2";
  if (is(1.0)) return "that is in multiples of the standard gravity";
  if (is(32.17)) return "that is ft/s^2";
  if (is(386.1)) return "that is in/s^2";
  return "the gravity of no place on Earth";
}

}  // namespace

void warn_of_gravity(TomlTable& robot, const Cell& cell) {
  const toml::node* node = robot.node("gravity");
  const auto& g = cell.gravity;
  const double size = std::hypot(g[0], g[1], g[2]);
  // A vector of zeros switches gravity off.
  if (node == nullptr || size == 0.0 || std::abs(size - kStandard) <= kNearGravity) return;
  const auto on_earth = [&](double x) { return x == 0.0 ? 0.0 : x / size * kStandard; };
  robot.warning("W-CELL-GRAVITY",
                fmt::format("'{}' is {:.6g} m/s^2, {:.4g} times 9.81", robot.name("gravity"), size,
                            size / kStandard),
                *node, unit_of_gravity(size),
                fmt::format("gravity = [{:.4g}, {:.4g}, {:.4g}]", on_earth(g[0]), on_earth(g[1]),
                            on_earth(g[2])));
}

void warn_of_mass(TomlTable& table, std::optional<double> mass_kg) {
  const toml::node* node = table.node("mass_kg");
  if (node == nullptr || !mass_kg || *mass_kg <= kHeaviestLink_kg) return;
  table.warning("W-CELL-MASS",
                fmt::format("'{}' is {:.6g} tonnes", table.name("mass_kg"), *mass_kg * 1e-3), *node,
                "given in grams?",
                fmt::format("if these are grams: mass_kg = {:.6g}", *mass_kg * 1e-3));
}

void warn_of_units(TomlTable& joint, const format::JointRow& row, const Cell& cell) {
  warn_of_angle(joint, "alpha", row.alpha, cell);
  warn_of_angle(joint, "theta", row.theta, cell);
  warn_of_length(joint, "a", row.a);
  warn_of_length(joint, "d", row.d);
  warn_of_limits(joint, row);
}

}  // namespace plumb::offline
