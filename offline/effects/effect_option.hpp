// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "effects/effect_entry.hpp"

namespace plumb::offline {

/// Everything that an effect may be told beside its joints. One key means the same in every effect.
enum class OptionKey {
  kCyclesPerTurn,
  kTorque_Nm,
  kTransition,
  kTransition_mm,
  kPitch_mm,
  kSettling,
  kSensor,
  kReferenceTemperature,
  kAfterRow,
  kOf,
  kLengthRatio,
  kAnchorRatio,
  kMinGain,
  kForm,
  kSplits,
  kTreeDegree,
  kWaves,
  kSize_urad,
  kSlope,
};

/// What the cell file and --set call it, with the unit as suffix: "torque_Nm".
const char* option_name(OptionKey key);

/// One option of an effect, in the cell file as in --set KEY=VALUE.
struct EffectOption {
  enum class Takes { kNumber, kWhole, kShare, kText, kWord };
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  OptionKey key;
  Takes takes = Takes::kNumber;
  const char* rule = "";     // what makes sense: "greater than 0"
  const char* example = "";  // a value that does
  double above = -kNone;     // of a number: greater than this,
  double least = -kNone;     // not less than this,
  double most = kNone;       // nor more than this
  std::span<const char* const> words = {};
  const char* assumed = nullptr;  // the word that is meant where nothing is said
  bool required = false;
  bool lists = false;  // several values are as many effects of that name
  /// Numbers outside of this range are allowed, but `plumb check` warns that no arm has them.
  double credible_least = -kNone;
  double credible_most = kNone;
  const char* credible_help = "";  // what the number is likely meant to be

  const char* name() const { return option_name(key); }
};

/// The number that an entry gives for this option, or `fallback` if it gives none.
double number_option(const EffectEntry& entry, OptionKey key, double fallback);

/// The text that an entry gives for this option, or `fallback` if it gives none.
std::string text_option(const EffectEntry& entry, OptionKey key, const std::string& fallback);

bool has_option(const EffectEntry& entry, OptionKey key);
void set_option(EffectEntry& entry, OptionKey key, EffectEntry::Value value);

}  // namespace plumb::offline
