// SPDX-License-Identifier: Apache-2.0
#include "diagnose/effect_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/formula_reader.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kWavesShown = 2;

/// The title of the law, or of the entry where its law has words for that.
std::string entry_title(const Cell& cell, const EffectEntry& entry) {
  const EffectDescriptor* effect = find_descriptor(entry.name);
  if (effect == nullptr || effect->entry_title == nullptr) return title_of(entry.name);
  return effect->entry_title(
      entry, entry.joints.empty() ? "" : cell.nominal.joints[entry.joints.front()].name);
}

}  // namespace

std::string title_of(const std::string& effect) {
  const EffectDescriptor* const found = find_descriptor(effect);
  return found != nullptr && found->law != nullptr ? found->law->title : effect;
}

std::string waves_words(const std::vector<double>& cycles) {
  if (cycles.size() > kWavesShown)
    return fmt::format("{} waves, the largest at {:.3g} cycles a turn", cycles.size(),
                       cycles.front());
  std::string out;
  for (std::size_t i = 0; i < cycles.size(); ++i)
    out += fmt::format("{}{:g}", i == 0 ? "" : i + 1 == cycles.size() ? " and " : ", ", cycles[i]);
  return out + " cycles a turn";
}

std::string in_words(const Cell& cell, const EffectEntry& entry) {
  std::vector<double> cycles;
  if (has_option(entry, OptionKey::kCyclesPerTurn))
    cycles = {number_option(entry, OptionKey::kCyclesPerTurn, 0.0)};
  return in_words(cell, entry, cycles);
}

std::string in_words(const Cell& cell, const EffectEntry& entry,
                     const std::vector<double>& cycles) {
  if (is_formula(entry.name) && entry.options.contains("target"))
    return fmt::format("formula {}", formula_label(formula_text(entry)));
  const std::string waves = cycles.empty()                ? ""
                            : cycles.size() > kWavesShown ? fmt::format(", {} waves", cycles.size())
                                                          : ", " + waves_words(cycles);
  return fmt::format("{}{} ({})", entry_title(cell, entry), waves, command_name(cell, entry));
}

namespace {

std::string in_words(const Cell& cell, EffectEntry entry, const std::vector<double>& cycles,
                     const std::vector<Move>& moves) {
  if (moves.empty()) return offline::in_words(cell, entry, cycles);
  entry.options.erase(option_name(OptionKey::kAfterRow));
  std::string rows;
  for (std::size_t i = 0; i < moves.size(); ++i)
    rows += fmt::format("{}{:g}",
                        i == 0                  ? ""
                        : i + 1 == moves.size() ? " and "
                                                : ", ",
                        moves[i].after_row);
  return fmt::format("{} after rows {} ({})", entry_title(cell, entry), rows,
                     command_name(cell, entry));
}

}  // namespace

std::string in_words(const Cell& cell, const Candidate& candidate) {
  return in_words(cell, candidate.entry, candidate.cycles, candidate.moves);
}

std::string in_words(const Cell& cell, const Addition& added) {
  if (!added.sizes.empty())
    return fmt::format("gear errors of several joints, {} ({})", added.sizes,
                       command_name(cell, added.entry));
  return in_words(cell, added.entry, added.cycles, added.moves);
}

std::string key_in_words(std::string key) {
  std::replace(key.begin(), key.end(), ',', '+');
  return fmt::format("{} ({})", title_of(key.substr(0, key.find(':'))), key);
}

std::string command_name(const Cell& cell, const EffectEntry& entry) {
  std::string out = entry.name;
  for (std::size_t i = 0; i < entry.joints.size(); ++i)
    out += (i == 0 ? ":" : "+") + cell.nominal.joints[entry.joints[i]].name;
  return out;
}

std::string planning_argument(const Cell& cell, const EffectEntry& effect) {
  std::string out = command_name(cell, effect);
  for (const auto& [key, value] : effect.options)
    if (const auto* number = std::get_if<double>(&value))
      out += fmt::format("@{}={}", key, *number);
  return out;
}

}  // namespace plumb::offline
