// SPDX-License-Identifier: Apache-2.0
#include "cell/column_names.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <utility>

#include "program/problem.hpp"

namespace plumb::offline {
namespace {

using Names = std::map<std::string, Quantity, std::less<>>;

const Names& unitless_names() {
  static const Names names{
      {"pose", Quantity::kText},   {"set", Quantity::kText},      {"note", Quantity::kText},
      {"time", Quantity::kText},   {"joint", Quantity::kText},    {"type", Quantity::kText},
      {"status", Quantity::kText}, {"setup", Quantity::kText},    {"repeat", Quantity::kNumber},
      {"point", Quantity::kText},  {"to_point", Quantity::kText}, {"position", Quantity::kText},
      {"plane", Quantity::kText},  {"sphere", Quantity::kText},   {"anchor", Quantity::kText},
      {"fold", Quantity::kNumber}, {"qw", Quantity::kNumber},     {"qx", Quantity::kNumber},
      {"qy", Quantity::kNumber},   {"qz", Quantity::kNumber},     {"pqw", Quantity::kNumber},
      {"pqx", Quantity::kNumber},  {"pqy", Quantity::kNumber},    {"pqz", Quantity::kNumber},
      {"cqw", Quantity::kNumber},  {"cqx", Quantity::kNumber},    {"cqy", Quantity::kNumber},
      {"cqz", Quantity::kNumber},
  };
  return names;
}

const Names& names_with_unit() {
  static const Names names = [] {
    Names out{{"payload", Quantity::kMass},     {"temp", Quantity::kTemperature},
              {"t", Quantity::kTime},           {"distance", Quantity::kLength},
              {"extension", Quantity::kLength}, {"height", Quantity::kLength},
              {"radius", Quantity::kLength}};
    for (const char* axis : {"x", "y", "z"}) {
      out.emplace(std::string("f") + axis, Quantity::kForce);
      out.emplace(std::string("m") + axis, Quantity::kTorque);
    }
    for (const char* prefix : {"", "n", "s", "p", "c", "payload_c"})
      for (const char* axis : {"x", "y", "z"})
        out.emplace(std::string(prefix) + axis, Quantity::kLength);
    for (const char* turn : {"rx", "ry", "rz"}) out.emplace(turn, Quantity::kAngle);
    return out;
  }();
  return names;
}

/// Names that other programs give to columns, and the names that they have here.
const std::map<std::string, std::string, std::less<>>& other_words() {
  static const std::map<std::string, std::string, std::less<>> words = [] {
    std::map<std::string, std::string, std::less<>> out{
        {"temperature", "temp"}, {"time", "t"}, {"load", "payload"}};
    for (const char* prefix : {"sigma_", "sigma", "std_", "sd_"})
      for (const char* axis : {"x", "y", "z"})
        out.emplace(std::string(prefix) + axis, std::string("s") + axis);
    return out;
  }();
  return words;
}

/// Letters that may be wrong, missing, too many or swapped.
constexpr int kMostSlips = 2;
/// Shorter names are not compared, because any two of them differ by few letters.
constexpr std::size_t kShortest = 3;

bool near(std::string_view word, std::string_view known) {
  if (word.size() < kShortest || known.size() <= kShortest) return false;
  const int most = std::min(kMostSlips, std::max(1, static_cast<int>(word.size()) / 3));
  return edit_distance(std::string(word), std::string(known)) <= most;
}

std::string lower(std::string_view text) {
  std::string out;
  for (const char c : text) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

bool is_known(std::string_view name) {
  return unitless_quantity(name).has_value() || !allowed_quantities(name).empty();
}

/// "travl_j3": the word, and the number that ends it.
std::pair<std::string_view, std::string_view> split_number(std::string_view name) {
  std::size_t end = name.size();
  while (end > 0 && std::isdigit(static_cast<unsigned char>(name[end - 1])) != 0) --end;
  return {name.substr(0, end), name.substr(end)};
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
    case Quantity::kForce:
      return "N";
    case Quantity::kTorque:
      return "Nm";
    default:
      return name.starts_with('s') ? "um" : "mm";
  }
}

std::optional<std::string> known_spelling(std::string_view name) {
  const std::string small = lower(name);
  if (small == name || !is_known(small)) return std::nullopt;
  return small;
}

std::optional<std::string> misspelt(std::string_view name, Quantity quantity) {
  const std::string small = lower(name);
  const auto fits = [&](std::string_view known) {
    const auto allowed = allowed_quantities(known);
    return std::find(allowed.begin(), allowed.end(), quantity) != allowed.end();
  };
  if (const auto other = other_words().find(small); other != other_words().end())
    return fits(other->second) ? std::optional(other->second) : std::nullopt;
  if (is_known(small)) return std::nullopt;
  for (const auto& [known, kind] : names_with_unit())
    if (kind == quantity && near(small, known)) return known;
  if (const auto [word, number] = split_number(small); !number.empty() && near(word, "travel_j"))
    if (const std::string travel = "travel_j" + std::string(number); fits(travel)) return travel;
  const auto bar = small.find('_');
  if (quantity == Quantity::kTemperature && bar != std::string::npos && bar + 1 < small.size() &&
      (near(small.substr(0, bar), "temp") || small.starts_with("temperature_")))
    return "temp" + std::string(name.substr(bar));
  return std::nullopt;
}

std::optional<std::string> misspelt_header(std::string_view header) {
  const std::string small = lower(header);
  if (unitless_quantity(small)) return small;
  if (!allowed_quantities(small).empty()) return small + "_" + usual_unit(small);
  for (const auto& [known, kind] : unitless_names())
    if (near(small, known)) return known;
  const auto [word, number] = split_number(small);
  if (!number.empty() && (near(word, "dir_j") || word == "direction_j"))
    return "dir_j" + std::string(number);
  for (const Quantity kind : {Quantity::kMass, Quantity::kTemperature, Quantity::kLength,
                              Quantity::kAngle, Quantity::kTime})
    if (const auto known = misspelt(small, kind)) return *known + "_" + usual_unit(*known);
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
