// SPDX-License-Identifier: Apache-2.0
#include "cell/toml_text.hpp"

#include <fmt/format.h>

#include <charconv>

#include "cell/rotation.hpp"

namespace plumb::offline {
namespace {

constexpr int kFewestDigits = 6, kMostDigits = 17;

std::string rounded(double value, int digits) {
  return fmt::format("{:.{}g}", value + 0.0, digits);
}

double parsed(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string rpy_text(const std::array<double, 4>& q, const Unit& angle) {
  const auto rpy = rpy_from_quaternion(q);
  std::string out;
  for (int digits = kFewestDigits; digits <= kMostDigits; ++digits) {
    std::array<std::string, 3> texts;
    std::array<double, 3> back{};
    for (int k = 0; k < 3; ++k) {
      texts[k] = rounded(angle.from_si(rpy[k]), digits);
      back[k] = angle.to_si(parsed(texts[k]));
    }
    out = fmt::format("[{}]", fmt::join(texts, ", "));
    if (quaternion_from_rpy(back) == q) break;
  }
  return out;
}

}  // namespace

std::string toml_string(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (code < 0x20 || code == 0x7F)
      out += fmt::format("\\u{:04X}", code);
    else
      out += c;
  }
  return out + "\"";
}

std::string toml_list(const std::array<double, 3>& si, const Unit& unit) {
  return fmt::format("[{}, {}, {}]", text_in(unit, si[0]), text_in(unit, si[1]),
                     text_in(unit, si[2]));
}

std::string toml_list(const std::vector<std::string>& texts) {
  std::vector<std::string> quoted;
  for (const auto& text : texts) quoted.push_back(toml_string(text));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

std::string toml_value(const EffectEntry::Value& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  // Whoever reads it back compares: the shortest digits that mean the very same number.
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number + 0.0);
  if (const auto* text = std::get_if<std::string>(&value)) return toml_string(*text);
  return toml_list(std::get<std::vector<std::string>>(value));
}

std::string toml_coupling(const format::Chain& arm) {
  std::vector<std::string> entries;
  for (const auto& [joint, by, ratio] : arm.coupling)
    entries.push_back(fmt::format("{{ joint = {}, of = {}, share = {} }}",
                                  toml_string(arm.joints[joint].name),
                                  toml_string(arm.joints[by].name), text_in(Unit{}, -ratio)));
  return fmt::format("[{}]", fmt::join(entries, ", "));
}

std::string toml_pose(const format::Pose& pose, const Unit& length, const Unit& angle) {
  return fmt::format("{{ xyz = {}, rpy = {} }}", toml_list(pose.p, length),
                     rpy_text(pose.q, angle));
}

}  // namespace plumb::offline
