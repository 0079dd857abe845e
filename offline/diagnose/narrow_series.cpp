// SPDX-License-Identifier: Apache-2.0
#include "diagnose/narrow_series.hpp"

#include <algorithm>

#include "cell/effects_edit.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/series_scan.hpp"
#include "diagnose/unless_refused.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

bool narrow(Selection& s, Found& found) {
  const FittedModel without = s.fitted(without_effect(s.cell().effects, found.entry));
  const WhitenedFit whitened = s.whitened_fit_of(without);
  const EffectEntry entry = with_narrowest_prior(Scorer(whitened), found.entry);
  if (same_effect(entry, found.entry)) return false;
  FittedModel next = s.fitted(with_effect(without.cell->effects, entry));
  found.entry = entry;
  s.look_at(std::move(next));
  return true;
}

}  // namespace

bool narrow_series(Selection& s) {
  for (Found& found : s.added) {
    if (!is_series(found.entry.name) || !s.renewed.insert(s.key(found.entry)).second) continue;
    bool done = false;
    if (!unless_refused([&] { done = narrow(s, found); })) s.not_compared_without(found.entry);
    if (done) return true;
  }
  return false;
}

}  // namespace plumb::offline
