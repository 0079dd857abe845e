// SPDX-License-Identifier: Apache-2.0
#include "cell/column_names.hpp"

#include <cctype>
#include <charconv>
#include <map>

namespace plumb::offline {
namespace {

using Names = std::map<std::string, Quantity, std::less<>>;

const Names& unitless_names() {
  static const Names names{
      {"pose", Quantity::kText},     {"set", Quantity::kText},    {"note", Quantity::kText},
      {"time", Quantity::kText},     {"joint", Quantity::kText},  {"type", Quantity::kText},
      {"joint", Quantity::kText},    {"type", Quantity::kText},   {"status", Quantity::kText},
      {"repeat", Quantity::kNumber}, {"fold", Quantity::kNumber}, {"qw", Quantity::kNumber},
      {"qx", Quantity::kNumber},     {"qy", Quantity::kNumber},   {"qz", Quantity::kNumber},
      {"pqw", Quantity::kNumber},    {"pqx", Quantity::kNumber},  {"pqy", Quantity::kNumber},
      {"pqz", Quantity::kNumber},    {"cqw", Quantity::kNumber},  {"cqx", Quantity::kNumber},
      {"cqy", Quantity::kNumber},    {"cqz", Quantity::kNumber},
  };
  return names;
}

const Names& names_with_unit() {
  static const Names names = [] {
    Names out{
        {"payload", Quantity::kMass}, {"temp", Quantity::kTemperature}, {"t", Quantity::kTime}};
    for (const char* prefix : {"", "n", "s", "p", "c", "payload_c"})
      for (const char* axis : {"x", "y", "z"})
        out.emplace(std::string(prefix) + axis, Quantity::kLength);
    for (const char* turn : {"rx", "ry", "rz"}) out.emplace(turn, Quantity::kAngle);
    return out;
  }();
  return names;
}

bool belongs_to_joint(std::string_view name) {
  return joint_number(name, "q") > 0 || joint_number(name, "qc") > 0 ||
         joint_number(name, "travel_j") > 0;
}

}  // namespace

int joint_number(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix) || name.size() == prefix.size()) return 0;
  const char* begin = name.data() + prefix.size();
  const char* end = name.data() + name.size();
  int number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc{} && stop == end && *begin != '0' && number > 0 ? number : 0;
}

std::optional<Quantity> unitless_quantity(std::string_view header) {
  const auto found = unitless_names().find(header);
  if (found != unitless_names().end()) return found->second;
  if (joint_number(header, "dir_j") > 0) return Quantity::kNumber;
  return std::nullopt;
}

std::vector<Quantity> allowed_quantities(std::string_view name) {
  const auto found = names_with_unit().find(name);
  if (found != names_with_unit().end()) return {found->second};
  if (belongs_to_joint(name)) return {Quantity::kAngle, Quantity::kLength};
  if (name.starts_with("temp_")) return {Quantity::kTemperature};
  return {};
}

std::string usual_unit(std::string_view name) {
  const auto allowed = allowed_quantities(name);
  if (allowed.empty()) return "mm";
  switch (allowed.front()) {
    case Quantity::kAngle:
      return "deg";
    case Quantity::kMass:
      return "kg";
    case Quantity::kTemperature:
      return "degC";
    case Quantity::kTime:
      return "s";
    default:
      return name.starts_with('s') ? "um" : "mm";
  }
}

std::optional<std::string> known_spelling(std::string_view name) {
  std::string lower;
  for (const char c : name) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (lower == name) return std::nullopt;
  if (unitless_quantity(lower) || !allowed_quantities(lower).empty()) return lower;
  return std::nullopt;
}

const char* kind_name(Quantity quantity) {
  switch (quantity) {
    case Quantity::kText:
      return "a text";
    case Quantity::kNumber:
      return "a plain number";
    case Quantity::kLength:
      return "a length";
    case Quantity::kAngle:
      return "an angle";
    case Quantity::kMass:
      return "a mass";
    case Quantity::kTemperature:
      return "a temperature";
    case Quantity::kTime:
      return "a time";
    case Quantity::kForce:
      return "a force";
    default:
      return "a torque";
  }
}

}  // namespace plumb::offline
