// SPDX-License-Identifier: Apache-2.0
#include "effects/effect_option.hpp"

#include <utility>

namespace plumb::offline {

const char* option_name(OptionKey key) {
  switch (key) {
    case OptionKey::kCyclesPerTurn:
      return "cycles_per_turn";
    case OptionKey::kTorque_Nm:
      return "torque_Nm";
    case OptionKey::kTransition:
      return "transition_deg";
    case OptionKey::kTransition_mm:
      return "transition_mm";
    case OptionKey::kPitch_mm:
      return "pitch_mm";
    case OptionKey::kSettling:
      return "settling_s";
    case OptionKey::kSensor:
      return "sensor";
    case OptionKey::kReferenceTemperature:
      return "reference_degC";
    case OptionKey::kAfterRow:
      return "after_row";
    case OptionKey::kOf:
      return "of";
    case OptionKey::kLengthRatio:
      return "length_ratio";
    case OptionKey::kAnchorRatio:
      return "anchor_ratio";
    case OptionKey::kMinGain:
      return "min_gain";
    case OptionKey::kForm:
      return "form";
    case OptionKey::kSplits:
      return "splits";
    case OptionKey::kTreeDegree:
      return "degree";
    case OptionKey::kWaves:
      return "waves";
    case OptionKey::kSize_urad:
      return "size_urad";
    case OptionKey::kSlope:
      return "slope";
  }
  return "";
}

double number_option(const EffectEntry& entry, OptionKey key, double fallback) {
  const auto at = entry.options.find(option_name(key));
  if (at == entry.options.end()) return fallback;
  const double* number = std::get_if<double>(&at->second);
  return number != nullptr ? *number : fallback;
}

std::string text_option(const EffectEntry& entry, OptionKey key, const std::string& fallback) {
  const auto at = entry.options.find(option_name(key));
  if (at == entry.options.end()) return fallback;
  const auto* text = std::get_if<std::string>(&at->second);
  return text != nullptr ? *text : fallback;
}

bool has_option(const EffectEntry& entry, OptionKey key) {
  return entry.options.contains(option_name(key));
}

void set_option(EffectEntry& entry, OptionKey key, EffectEntry::Value value) {
  entry.options[option_name(key)] = std::move(value);
}

}  // namespace plumb::offline
