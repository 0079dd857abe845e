// SPDX-License-Identifier: Apache-2.0
#include "show/effect_arguments.hpp"

#include <fmt/format.h>

#include "cell/formula_reader.hpp"
#include "program/shell_word.hpp"

namespace plumb::offline::show {
namespace {

std::string formula_arguments(const EffectEntry& effect) {
  const FormulaText text = formula_text(effect);
  std::string out = "formula --formula " + shell_word(text.target + " = " + text.expression);
  for (const auto& parameter : text.parameters) out += " --parameter " + shell_word(parameter);
  if (!text.name.empty()) out += " --name " + text.name;
  if (effect.options.contains("domain")) out += " --domain " + text.domain;
  return out;
}

}  // namespace

std::string adding_arguments(const Cell& cell, const EffectEntry& effect) {
  if (effect.name == "formula" && effect.options.contains("target"))
    return formula_arguments(effect);
  std::string out = effect.name;
  for (std::size_t i = 0; i < effect.joints.size(); ++i)
    out += (i == 0 ? " --joints " : ",") + cell.nominal.joints[effect.joints[i]].name;
  for (const auto& [key, value] : effect.options) {
    out += fmt::format(" --set {}=", key);
    if (const auto* number = std::get_if<double>(&value)) out += fmt::format("{}", *number);
    if (const auto* text = std::get_if<std::string>(&value)) out += shell_word(*text);
  }
  return out;
}

std::string dropping_arguments(const Cell& cell, const EffectEntry& effect) {
  if (effect.name == "formula") return "formula --name " + formula_label(formula_text(effect));
  return adding_arguments(cell, effect);
}

std::string planning_argument(const Cell& cell, const EffectEntry& effect) {
  std::string out = effect.name;
  for (std::size_t i = 0; i < effect.joints.size(); ++i)
    out += (i == 0 ? ":" : "+") + cell.nominal.joints[effect.joints[i]].name;
  for (const auto& [key, value] : effect.options)
    if (const auto* number = std::get_if<double>(&value))
      out += fmt::format("@{}={}", key, *number);
  return out;
}

}  // namespace plumb::offline::show
