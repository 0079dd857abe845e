// SPDX-License-Identifier: Apache-2.0
#include "simulate/hidden_effect_text.hpp"

#include <utility>

#include "simulate/law_list.hpp"

namespace plumb::offline {
namespace {

/// The number with the fewest digits that read back to the same double.
std::string number_text(double value) { return nlohmann::ordered_json(value).dump(); }

std::string size_text(const std::optional<double>& size, const sim::LawEntry& law) {
  if (!size) return "";
  return "=" + number_text(*size) + (law.size == sim::LawEntry::Size::kAngle ? "rad" : "m");
}

}  // namespace

std::string hidden_effect_text(const HiddenEffect& effect, const Cell& cell) {
  const sim::LawEntry& law = *sim::find_law(effect.name);
  std::string out = effect.name + size_text(effect.size, law);
  char before = ':';
  for (const auto& part : effect.joints) {
    out += std::exchange(before, ',');
    out += cell.nominal.joints[static_cast<std::size_t>(part.joint)].name;
    out += size_text(part.size, law);
  }
  before = '@';
  for (const auto& [key, value] : effect.numbers) {
    out += std::exchange(before, ',');
    out += key + "=" + number_text(value);
  }
  return out;
}

}  // namespace plumb::offline
