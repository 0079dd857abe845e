// SPDX-License-Identifier: Apache-2.0
#include "cell/units.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace plumb::offline {
namespace {

constexpr std::array<std::pair<std::string_view, Unit>, 16> kUnits{{
    {"mm", {Quantity::kLength, 1e-3}},
    {"m", {Quantity::kLength, 1.0}},
    {"um", {Quantity::kLength, 1e-6}},
    {"in", {Quantity::kLength, 0.0254}},
    {"deg", {Quantity::kAngle, M_PI / 180.0}},
    {"rad", {Quantity::kAngle, 1.0}},
    {"mrad", {Quantity::kAngle, 1e-3}},
    {"urad", {Quantity::kAngle, 1e-6}},
    {"kg", {Quantity::kMass, 1.0}},
    {"g", {Quantity::kMass, 1e-3}},
    {"degC", {Quantity::kTemperature, 1.0}},
    {"K", {Quantity::kTemperature, 1.0, -273.15}},
    {"s", {Quantity::kTime, 1.0}},
    {"ms", {Quantity::kTime, 1e-3}},
    {"us", {Quantity::kTime, 1e-6}},
    {"N", {Quantity::kForce, 1.0}},
}};

}  // namespace

std::optional<Unit> unit_of(std::string_view name) {
  if (name == "Nm") return Unit{Quantity::kTorque, 1.0};
  for (const auto& [text, unit] : kUnits)
    if (text == name) return unit;
  return std::nullopt;
}

Heading split_heading(std::string_view header) {
  const auto at = header.rfind('_');
  if (at == std::string_view::npos || at == 0) return {std::string(header), ""};
  return {std::string(header.substr(0, at)), std::string(header.substr(at + 1))};
}

std::string unit_list() {
  std::string out;
  for (const auto& [text, unit] : kUnits) out += std::string(text) + " ";
  return out + "Nm";
}

}  // namespace plumb::offline
