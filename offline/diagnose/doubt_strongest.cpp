// SPDX-License-Identifier: Apache-2.0
#include "diagnose/doubt_strongest.hpp"

#include <algorithm>

#include "diagnose/constants.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/found_list.hpp"
#include "diagnose/model_parts.hpp"
#include "diagnose/rivals.hpp"
#include "diagnose/unless_refused.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

/// Takes out effects that lost their evidence to `fresh`.
void drop_weak(Selection& s, const EffectEntry& fresh) {
  while (const auto weak =
             lost(s.cell(), s.whitened(), s.calibration(), s.start().cell.effects, fresh)) {
    s.look_at(s.fitted(without_effect(s.cell().effects, *weak)));
    forget(s.added, *weak);
  }
}

bool replace(Selection& s, const Found& found) {
  const JudgedModel without = s.without(found.entries(), s.banned());
  const auto better = better_explanation(without.whitened, without.look, s.key(found.entry),
                                         s.start().not_testable, s.banned());
  if (!better) return false;
  s.remember_alternatives(without, better->effects.front());
  auto effects = without.model.cell->effects;
  for (const auto& one : better->effects) effects = with_found(std::move(effects), one);
  s.look_at(s.fitted(effects));
  for (const auto& entry : found.entries()) forget(s.added, entry);
  s.added.insert(s.added.end(), better->effects.begin(), better->effects.end());
  drop_weak(s, better->effects.back().entry);
  return true;
}

}  // namespace

bool doubt_strongest(Selection& s) {
  if (s.look().supported() == nullptr || times_noise(s.whitened()) < kAboveNoise) return false;
  const auto strongest =
      std::max_element(s.added.begin(), s.added.end(),
                       [](const Found& a, const Found& b) { return a.ln_bayes() < b.ln_bayes(); });
  if (strongest == s.added.end() || is_wave(strongest->entry.name) ||
      is_series(strongest->entry.name))
    return false;
  const Found found = *strongest;
  if (!s.doubted.insert(s.key(found.entry)).second) return false;
  bool replaced = false;
  if (!unless_refused([&] { replaced = replace(s, found); })) s.not_compared_without(found.entry);
  return replaced;
}

}  // namespace plumb::offline
