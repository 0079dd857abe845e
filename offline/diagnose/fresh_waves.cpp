// SPDX-License-Identifier: Apache-2.0
#include "diagnose/fresh_waves.hpp"

#include <algorithm>

#include "diagnose/constants.hpp"
#include "diagnose/unless_refused.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

/// Whether the selection has added waves at that joint; those given by the user are not changed.
bool has_waves_of_its_own(const Selection& s, const EffectEntry& entry) {
  const auto waves = [&](const EffectEntry& e) {
    return is_wave(e.name) && e.joints == entry.joints;
  };
  const auto &effects = s.cell().effects, &given = s.start().cell.effects;
  return waves(entry) && std::any_of(effects.begin(), effects.end(), waves) &&
         std::none_of(given.begin(), given.end(), waves);
}

}  // namespace

Found with_fresh_waves(Selection& s, Found best) {
  const std::string key = s.key(best.entry);
  if (!has_waves_of_its_own(s, best.entry) || !s.first_time("fresh waves", key)) return best;
  const EffectEntry all{
      .name = wave_effect(), .joints = best.entry.joints, .options = {}, .place = {}};
  const bool compared = unless_refused([&] {
    JudgedModel waves_out = s.without(all, s.banned());
    const Found* again = waves_out.look.find(s.cell(), key);
    if (again == nullptr || again->score <= kSupported) return;
    best = *again;
    std::erase_if(s.added, [&](const Found& f) { return s.key(f.entry) == key; });
    s.go_to(std::move(waves_out));
  });
  if (!compared) s.not_compared_without(all);
  return best;
}

}  // namespace plumb::offline
