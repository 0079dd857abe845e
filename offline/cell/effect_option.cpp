// SPDX-License-Identifier: Apache-2.0
#include "cell/effect_option.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "cell/cell.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

using Takes = EffectOption::Takes;

bool is_text(const EffectOption& option) {
  return option.takes == Takes::kText || option.takes == Takes::kWord;
}

std::optional<double> number_of(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

bool slides(const format::JointRow& row) { return row.type == format::JointType::kPrismatic; }

/// Of an effect that only joints that slide can have.
std::string sliding_fault(const std::vector<int>& joints, const format::Chain& arm) {
  if (std::none_of(arm.joints.begin(), arm.joints.end(), slides))
    return "needs a joint that slides, and this arm has none";
  for (const int joint : joints)
    if (const auto& row = arm.joints[static_cast<std::size_t>(joint)]; !slides(row))
      return "is of joints that slide, and " + row.name + " turns";
  return "";
}

}  // namespace

std::span<const EffectOption> options_of(std::string_view effect) {
  const EffectDescriptor* found = find_descriptor(effect);
  return found != nullptr ? found->options : std::span<const EffectOption>();
}

const EffectOption* find_option(std::string_view effect, std::string_view key) {
  for (const auto& option : options_of(effect))
    if (option.name() == key) return &option;
  return nullptr;
}

bool makes_sense(const EffectOption& option, double value) {
  if (is_text(option) || !std::isfinite(value)) return false;
  if (option.takes == Takes::kShare) return value >= 0.0 && value < 1.0;
  if (option.takes == Takes::kWhole && value != std::floor(value)) return false;
  return value > option.above && value >= option.least && value <= option.most;
}

bool makes_sense(const EffectOption& option, const std::string& text) {
  if (option.takes == Takes::kText) return !text.empty();
  return option.takes == Takes::kWord &&
         std::find(option.words.begin(), option.words.end(), text) != option.words.end();
}

std::optional<EffectEntry::Value> option_value(const EffectOption& option,
                                               const std::string& text) {
  if (is_text(option))
    return makes_sense(option, text) ? std::optional<EffectEntry::Value>(text) : std::nullopt;
  auto number = number_of(text);
  if (!number && option.takes == Takes::kShare) number = parse_percent(text);
  if (!number || !makes_sense(option, *number)) return std::nullopt;
  return *number;
}

void fill_in_usual(EffectEntry& entry) {
  for (const auto& option : options_of(entry.name))
    if (option.assumed != nullptr && !has_option(entry, option.key))
      set_option(entry, option.key, std::string(option.assumed));
}

std::string joints_fault(const EffectEntry& entry, const format::Chain& arm) {
  const auto& joints = entry.joints;
  const std::set<int> different(joints.begin(), joints.end());
  const EffectDescriptor* effect = find_descriptor(entry.name);
  const JointList list = effect != nullptr ? effect->joints : JointList::kNone;
  if (list == JointList::kOrderedPair)
    return joints.size() == 2 && different.size() == 2
               ? ""
               : std::string("needs two joints: ") + effect->pair;
  if (different.size() != joints.size()) return "names a joint twice";
  if (list == JointList::kOneIfEncoder) {
    if (text_option(entry, OptionKey::kOf, "") == "joint")
      return joints.size() == 1 ? "" : "of = \"joint\" needs the one joint that slipped";
    return joints.empty() ? "" : "takes a joint only with of = \"joint\"";
  }
  if (list == JointList::kSliding) return sliding_fault(joints, arm);
  return joints.empty() || list == JointList::kSet ? "" : "takes no joints";
}

}  // namespace plumb::offline
