// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "effects/effect_option.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// Every option of an effect of the catalogue; formulas have their own.
std::span<const EffectOption> options_of(std::string_view effect);

/// Null if the effect has no such option.
const EffectOption* find_option(std::string_view effect, std::string_view key);

bool makes_sense(const EffectOption& option, double value);
bool makes_sense(const EffectOption& option, const std::string& text);

/// The value of a text, or nothing if it makes no sense for the option.
std::optional<EffectEntry::Value> option_value(const EffectOption& option, const std::string& text);

/// Fills in the words that are meant where nothing is said: a step is one of the tool.
void fill_in_usual(EffectEntry& entry);

/// Why the effect cannot have these joints of that arm: "takes no joints"; empty if it can.
std::string joints_fault(const EffectEntry& entry, const format::Chain& arm);

}  // namespace plumb::offline
