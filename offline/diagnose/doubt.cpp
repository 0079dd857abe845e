// SPDX-License-Identifier: Apache-2.0
#include "diagnose/doubt.hpp"

#include <algorithm>

#include "diagnose/constants.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/found_list.hpp"
#include "diagnose/model_parts.hpp"
#include "diagnose/rivals.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

std::vector<Found> strongest(const Selection& s) {
  if (s.look().supported() == nullptr || times_noise(s.whitened()) < kAboveNoise) return {};
  const auto best =
      std::max_element(s.added.begin(), s.added.end(),
                       [](const Found& a, const Found& b) { return a.ln_bayes() < b.ln_bayes(); });
  if (best == s.added.end() || is_wave(best->entry.name) || is_series(best->entry.name)) return {};
  return {*best};
}

std::optional<Proposal> others_in_its_place(const Selection& s, const Found& found) {
  const JudgedModel without = s.without(found.entries(), s.banned());
  const auto better = better_explanation(without.whitened, without.look, s.key(found.entry),
                                         s.start().not_testable, s.banned());
  const auto is_open = [&](const Found& one) { return s.is_open(one.entry); };
  if (!better || std::any_of(better->effects.begin(), better->effects.end(), is_open))
    return std::nullopt;
  auto effects = without.model.cell->effects;
  for (const auto& one : better->effects) effects = with_found(std::move(effects), one);
  return Proposal{.model = s.fitted(effects),
                  .out = found.entries(),
                  .in = better->effects,
                  .instead = s.alternatives_in(without, better->effects.front())};
}

/// Removes effects that are no longer supported since the last one was added.
void drop_weak(Selection& s) {
  const EffectEntry fresh = s.added.back().entry;
  while (const auto weak =
             lost(s.cell(), s.whitened(), s.calibration(), s.start().cell.effects, fresh)) {
    s.look_at(s.fitted(without_effect(s.cell().effects, *weak)));
    forget(s.added, *weak);
  }
}

}  // namespace

const Revision kDoubt{.name = "doubt",
                      .subjects = strongest,
                      .proposal = others_in_its_place,
                      .afterwards = drop_weak};

}  // namespace plumb::offline
