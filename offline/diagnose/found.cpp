// SPDX-License-Identifier: Apache-2.0
#include "diagnose/found.hpp"

#include "diagnose/change_points.hpp"
#include "diagnose/series_scan.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {

std::vector<EffectEntry> Found::entries() const {
  std::vector<EffectEntry> out;
  for (const Move& move : moves) {
    out.push_back(entry);
    set_option(out.back(), OptionKey::kAfterRow, move.after_row);
  }
  if (!out.empty()) return out;
  if (!is_wave(entry.name)) return {entry};
  for (const double k : cycles) {
    out.push_back(entry);
    set_option(out.back(), OptionKey::kCyclesPerTurn, k);
  }
  return out;
}

Regressor regressor_of(const WhitenedFit& whitened, const Found& found) {
  if (is_series(found.entry.name)) return series_regressor(whitened, found.entry);
  if (!found.moves.empty()) {
    std::vector<double> after_rows;
    for (const Move& move : found.moves) after_rows.push_back(move.after_row);
    return moves_regressor(whitened, found.entry, after_rows);
  }
  return is_wave(found.entry.name)
             ? ripple_regressor(whitened, found.entry.joints.front(), found.cycles)
             : library_regressor(whitened, found.entry);
}

std::string key_of(const Cell& cell, const EffectEntry& entry) {
  std::string out = entry.name;
  for (std::size_t i = 0; i < entry.joints.size(); ++i)
    out += (i == 0 ? ":" : ",") + cell.nominal.joints[entry.joints[i]].name;
  if (const EffectDescriptor* effect = find_descriptor(entry.name);
      effect != nullptr && effect->told_apart_by != nullptr)
    out += "/" + text_option(entry, *effect->told_apart_by, "");
  return out;
}

}  // namespace plumb::offline
