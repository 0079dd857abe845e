// SPDX-License-Identifier: Apache-2.0
#include "cell/effect_arguments.hpp"

#include <fmt/format.h>

#include "cell/effects_edit.hpp"
#include "cell/formula_reader.hpp"
#include "effects/registry.hpp"
#include "program/shell_word.hpp"

namespace plumb::offline {
namespace {

std::string formula_arguments(const EffectEntry& effect) {
  const FormulaText text = formula_text(effect);
  std::string out = "formula --formula " + shell_word(text.target + " = " + text.expression);
  for (const auto& parameter : text.parameters) out += " --parameter " + shell_word(parameter);
  if (!text.name.empty()) out += " --name " + text.name;
  if (effect.options.contains("domain")) out += " --domain " + text.domain;
  return out;
}

constexpr const char* kCycles = "cycles_per_turn";
constexpr const char* kAfterRow = "after_row";

std::string value_text(const EffectEntry::Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? shell_word(*text) : std::string();
}

EffectEntry without_cycles(EffectEntry effect) {
  effect.options.erase(kCycles);
  return effect;
}

bool differ_in_cycles_alone(const EffectEntry& a, const EffectEntry& b) {
  return a.options.contains(kCycles) && b.options.contains(kCycles) &&
         same_effect(without_cycles(a), without_cycles(b));
}

}  // namespace

std::string adding_arguments(const Cell& cell, const EffectEntry& effect,
                             const std::vector<double>& cycles) {
  if (is_formula(effect.name) && effect.options.contains("target"))
    return formula_arguments(effect);
  std::string out = effect.name;
  for (std::size_t i = 0; i < effect.joints.size(); ++i)
    out += (i == 0 ? " --joints " : ",") + cell.nominal.joints[effect.joints[i]].name;
  for (const auto& [key, value] : effect.options)
    out += fmt::format(" --set {}={}", key,
                       (key == kCycles || key == kAfterRow) && !cycles.empty()
                           ? fmt::format("{}", fmt::join(cycles, ","))
                           : value_text(value));
  return out;
}

std::vector<std::string> adding_arguments(const Cell& cell,
                                          const std::vector<EffectEntry>& effects) {
  std::vector<std::string> out;
  std::vector<bool> said(effects.size(), false);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    std::vector<double> cycles;
    for (std::size_t k = i; k < effects.size(); ++k) {
      if (said[k] || !differ_in_cycles_alone(effects[i], effects[k])) continue;
      cycles.push_back(std::get<double>(effects[k].options.at(kCycles)));
      said[k] = k > i;
    }
    if (!said[i]) out.push_back(adding_arguments(cell, effects[i], cycles));
  }
  return out;
}

std::string dropping_arguments(const Cell& cell, const std::vector<EffectEntry>& effects) {
  if (is_formula(effects.front().name))
    return effects.front().name + " --name " + formula_label(formula_text(effects.front()));
  return fmt::format("{}", fmt::join(adding_arguments(cell, effects), " && plumb drop "));
}

}  // namespace plumb::offline
