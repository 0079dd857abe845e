// SPDX-License-Identifier: Apache-2.0
#include "diagnose/excluded_laws.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnose/ripple_scan.hpp"
#include "effects/registry.hpp"
#include "program/problem.hpp"

namespace plumb::offline {
namespace {

/// Every law of the library but one.
std::vector<std::string> all_but(const std::string& one) {
  std::vector<std::string> out;
  for (const EffectDescriptor* effect : effect_descriptors())
    if (effect->name != one) out.emplace_back(effect->name);
  return out;
}

/// The best of one law at each joint over the grid of its options.
void add_law(const Scorer& scorer, const std::string& law, double& tried, std::vector<Found>& out) {
  const WhitenedFit& whitened = scorer.whitened();
  std::map<std::string, Found> best;
  try {
    visit_library(whitened, all_but(law), [&](const Regressor& regressor) {
      ++tried;
      Found found{regressor.entry, {}, scorer.score(regressor), {}, 0.0, {}, 0.0};
      const std::string key = key_of(*whitened.cell, regressor.entry);
      const auto old = best.find(key);
      if (old == best.end() || old->second.ln_bayes() < found.ln_bayes())
        best.insert_or_assign(key, std::move(found));
    });
  } catch (const Failure&) {
    return;  // the columns that it needs are not there
  }
  for (auto& [key, found] : best) out.push_back(std::move(found));
}

void add_waves(const Scorer& scorer, double& tried, std::vector<Found>& out) {
  const WhitenedFit& whitened = scorer.whitened();
  for (int j = 0; j < whitened.joints(); ++j) {
    if (!whitened.chain.revolute(j)) continue;
    int waves = 0;
    const Ripples ripples = scan_ripples(scorer, j, tried, waves);
    tried += waves;
    if (ripples.cycles.empty()) continue;
    const Regressor regressor = ripple_regressor(whitened, j, ripples.cycles);
    out.push_back({regressor.entry, {}, scorer.score(regressor), {}, 0.0, ripples.cycles, 0.0});
  }
}

}  // namespace

std::vector<Found> excluded_laws(const WhitenedFit& whitened,
                                 const std::vector<std::string>& not_testable) {
  std::vector<Found> out;
  const Scorer scorer(whitened);
  double tried = 0.0;
  for (const auto& law : not_testable) {
    const EffectDescriptor* effect = find_descriptor(law);
    if (effect != nullptr && effect->search == Search::kGrid) add_law(scorer, law, tried, out);
    if (is_wave(law)) add_waves(scorer, tried, out);
  }
  const double paid = std::log(std::max(1.0, tried));
  for (auto& found : out) {
    const auto waves = static_cast<double>(std::max<std::size_t>(1, found.cycles.size()));
    found.score = found.ln_bayes() - waves * paid;
  }
  std::sort(out.begin(), out.end(),
            [](const Found& a, const Found& b) { return a.ln_bayes() > b.ln_bayes(); });
  return out;
}

}  // namespace plumb::offline
