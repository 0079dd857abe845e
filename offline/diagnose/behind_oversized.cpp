// SPDX-License-Identifier: Apache-2.0
#include "diagnose/behind_oversized.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "diagnose/candidates.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/model_parts.hpp"
#include "diagnose/unless_refused.hpp"
#include "effects/effect_option.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

double evidence_at(const WhitenedFit& whitened, const EffectEntry& entry) {
  const Scorer scorer(whitened);
  if (!is_wave(entry.name))
    return scorer.score(library_regressor(whitened, entry)).evidence.ln_bayes;
  const double cycles = number_option(entry, OptionKey::kCyclesPerTurn, 0.0);
  return scorer.score(ripple_regressor(whitened, entry.joints.front(), {cycles})).evidence.ln_bayes;
}

std::optional<UnknownStructure> behind(const Selection& s, const Oversized& one) {
  const JudgedModel without = s.without(one.entry, {});
  const auto& pattern = without.look.pattern;
  const bool only_large =
      one.possible && times_noise(s.whitened()) < kAboveNoise && pattern &&
      evidence_at(without.whitened, one.entry) > pattern->ln_bayes() + kAhead_nats;
  if (!pattern || only_large) return std::nullopt;
  UnknownStructure out = unknown_structure(without.whitened, *pattern);
  out.instead = one;
  for (const int joint : one.entry.joints) {
    const std::string q = fmt::format("q{}", joint + 1);
    auto& inputs = out.pattern.depends_on;
    if (std::find(inputs.begin(), inputs.end(), q) == inputs.end()) inputs.push_back(q);
  }
  return out;
}

}  // namespace

std::optional<UnknownStructure> behind_oversized(Selection& s, std::vector<Oversized>& unlikely) {
  for (const auto& one :
       oversized(s.cell(), s.whitened(), s.calibration(), s.start().cell.effects)) {
    std::optional<UnknownStructure> unknown;
    if (!unless_refused([&] { unknown = behind(s, one); })) s.not_compared_without(one.entry);
    if (unknown) return unknown;
    unlikely.push_back(one);
  }
  return std::nullopt;
}

}  // namespace plumb::offline
