// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "cell/cell.hpp"

namespace plumb::offline {

/// What an effect may be told beside its joints, in the cell file as in --set KEY=VALUE.
struct EffectOption {
  enum class Takes { kNumber, kWhole, kShare, kText, kWord };
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  std::string_view effect, key;
  Takes takes = Takes::kNumber;
  const char* rule = "";     // what makes sense: "greater than 0"
  const char* example = "";  // a value that does
  double above = -kNone;     // of a number: greater than this,
  double least = -kNone;     // not less than this,
  double most = kNone;       // nor more than this
  std::span<const char* const> words = {};
  bool required = false;
  bool lists = false;  // several values are as many effects of that name
};

/// Every option of an effect of the catalogue; formulas have their own.
std::vector<const EffectOption*> options_of(std::string_view effect);

/// Null if the effect has no such option.
const EffectOption* find_option(std::string_view effect, std::string_view key);

bool makes_sense(const EffectOption& option, double value);
bool makes_sense(const EffectOption& option, const std::string& text);

/// The value of a text, or nothing if it makes no sense for the option.
std::optional<EffectEntry::Value> option_value(const EffectOption& option, const std::string& text);

/// Fills in what is meant where nothing is said: a step is one of the tool.
void fill_in_usual(EffectEntry& entry);

/// Why the effect cannot have these joints: "takes no joints"; empty if it can.
std::string joints_fault(const EffectEntry& entry);

}  // namespace plumb::offline
