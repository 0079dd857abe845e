// SPDX-License-Identifier: Apache-2.0
#include "diagnose/found_list.hpp"

#include "diagnose/effect_list.hpp"
#include "effects/effect_option.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {

std::vector<EffectEntry> with_found(std::vector<EffectEntry> effects, const Found& found) {
  for (const auto& entry : found.entries()) effects = with_effect(std::move(effects), entry);
  return effects;
}

void forget(std::vector<Found>& all, const EffectEntry& entry) {
  for (auto& found : all) {
    if (found.entry.name != entry.name) continue;
    if (is_wave(entry.name)) {
      if (found.entry.joints != entry.joints) continue;
      std::erase(found.cycles, number_option(entry, OptionKey::kCyclesPerTurn, 0.0));
      if (found.cycles.empty()) found.entry.name.clear();
      continue;
    }
    if (!found.moves.empty()) {
      const auto all_moves = found.entries();
      std::vector<Move> left;
      for (std::size_t i = 0; i < all_moves.size(); ++i)
        if (!without_effect({all_moves[i]}, entry).empty()) left.push_back(found.moves[i]);
      found.moves = std::move(left);
      if (found.moves.empty())
        found.entry.name.clear();
      else
        set_option(found.entry, OptionKey::kAfterRow, found.moves.front().after_row);
      if (found.moves.size() == 1) found.moves.clear();  // an ordinary step
      continue;
    }
    const auto rest = without_effect({found.entry}, entry);
    if (rest.empty())
      found.entry.name.clear();
    else
      found.entry = rest.front();
  }
  std::erase_if(all, [](const Found& found) { return found.entry.name.empty(); });
}

}  // namespace plumb::offline
