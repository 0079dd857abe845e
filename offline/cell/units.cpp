// SPDX-License-Identifier: Apache-2.0
#include "cell/units.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace plumb::offline {
namespace {

/// Characters of a number that a person would write.
constexpr std::size_t kPlainLength = 12;
/// Relative distance of two neighbouring doubles, 2^-52.
constexpr double kLastPlace = 2.220446049250313e-16;

constexpr std::array<std::pair<std::string_view, Unit>, 17> kUnits{{
    {"mm", {Quantity::kLength, 1.0, 1e3}},
    {"m", {Quantity::kLength}},
    {"um", {Quantity::kLength, 1.0, 1e6}},
    {"in", {Quantity::kLength, 254.0, 1e4}},
    {"deg", {Quantity::kAngle, M_PI, 180.0}},
    {"rad", {Quantity::kAngle}},
    {"mrad", {Quantity::kAngle, 1.0, 1e3}},
    {"urad", {Quantity::kAngle, 1.0, 1e6}},
    {"kg", {Quantity::kMass}},
    {"g", {Quantity::kMass, 1.0, 1e3}},
    {"degC", {Quantity::kTemperature}},
    {"K", {Quantity::kTemperature, 1.0, 1.0, -273.15}},
    {"s", {Quantity::kTime}},
    {"ms", {Quantity::kTime, 1.0, 1e3}},
    {"us", {Quantity::kTime, 1.0, 1e6}},
    {"N", {Quantity::kForce}},
    {"Nm", {Quantity::kTorque}},
}};

constexpr auto kForeign = std::to_array<ForeignUnit>({
    {"cm", "mm", "1 cm = 10 mm"},
    {"dm", "mm", "1 dm = 100 mm"},
    {"km", "m", "1 km = 1000 m"},
    {"nm", "um", "1 nm = 0.001 um"},
    {"ft", "in", "1 ft = 12 in"},
    {"rev", "deg", "1 rev = 360 deg"},
    {"turns", "deg", "1 turn = 360 deg"},
    {"gon", "deg", "1 gon = 0.9 deg"},
    {"grad", "deg", "1 grad = 0.9 deg"},
    {"arcmin", "deg", "1 arcmin = 1/60 deg"},
    {"arcsec", "urad", "1 arcsec = 4.848137 urad"},
    {"lb", "kg", "1 lb = 0.45359237 kg"},
    {"degF", "degC", "x degF = (x - 32) 5/9 degC"},
    {"kN", "N", "1 kN = 1000 N"},
    {"lbf", "N", "1 lbf = 4.448222 N"},
    {"kNm", "Nm", "1 kNm = 1000 Nm"},
    {"ns", "us", "1 us = 1000 ns"},
});

}  // namespace

const ForeignUnit* foreign_unit(std::string_view name) {
  for (const auto& unit : kForeign)
    if (unit.name == name) return &unit;
  return nullptr;
}

std::optional<Unit> unit_of(std::string_view name) {
  for (const auto& [text, unit] : kUnits)
    if (text == name) return unit;
  return std::nullopt;
}

std::string text_in(const Unit& unit, double si) {
  const double value = unit.from_si(si) + 0.0;  // never "-0"
  std::string rounded = fmt::format("{:.15g}", value);
  double back = 0.0;
  std::from_chars(rounded.data(), rounded.data() + rounded.size(), back);
  const double slack = rounded.size() <= kPlainLength ? kLastPlace * std::abs(si) : 0.0;
  if (std::abs(unit.to_si(back) - si) <= slack) return rounded;
  double below = value, above = value;
  for (int step = 0; step < 3; ++step) {
    if (unit.to_si(above) == si) return fmt::format("{}", above);
    if (unit.to_si(below) == si) return fmt::format("{}", below);
    above = std::nextafter(above, INFINITY);
    below = std::nextafter(below, -INFINITY);
  }
  return fmt::format("{}", value);
}

Heading split_heading(std::string_view header) {
  const auto at = header.rfind('_');
  if (at == std::string_view::npos || at == 0) return {std::string(header), ""};
  return {std::string(header.substr(0, at)), std::string(header.substr(at + 1))};
}

const std::vector<std::string>& unit_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const auto& [text, unit] : kUnits) out.emplace_back(text);
    return out;
  }();
  return names;
}

}  // namespace plumb::offline
