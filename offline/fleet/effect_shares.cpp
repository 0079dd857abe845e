// SPDX-License-Identifier: Apache-2.0
#include "fleet/effect_shares.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "effects/registry.hpp"
#include "fleet/typical.hpp"

namespace plumb::offline::fleet {
namespace {

constexpr double kHave = 0.5, kHaveNot = 10.0;  // arms, before any is known: one of 21 has it
constexpr int kSteps = 100;

struct Count {
  double have = 0.0, have_not = 0.0;
  double odds() const { return (have + kHave) / (have_not + kHaveNot); }
};
using Counts = std::map<std::string, Count>;

/// What a fleet shares: a law of the arm, not what happens while it is measured, and not a formula
/// that somebody wrote for one arm.
bool is_shared(const std::string& effect) {
  const EffectDescriptor* const found = find_descriptor(effect);
  return found != nullptr && found->law != nullptr && found->law->domain == EffectDomain::kRobot &&
         !is_formula(effect);
}

/// An arm that tells: what its model holds, and the evidence for what it does not.
struct Told {
  std::set<std::string> held;
  std::vector<EffectEvidence> evidence;

  bool says(const std::string& effect) const {
    return !held.empty() || std::any_of(evidence.begin(), evidence.end(),
                                        [&](const auto& one) { return one.effect == effect; });
  }
};

std::vector<Told> told_by(const std::vector<const CellSummary*>& arms) {
  std::vector<Told> out;
  for (const auto* arm : arms) {
    Told one;
    for (const auto& effect : arm->effects)
      if (is_shared(effect)) one.held.insert(effect);
    if (arm->diagnosis)
      for (const auto& candidate : arm->diagnosis->evidence)
        if (is_shared(candidate.effect) && !one.held.contains(candidate.effect))
          one.evidence.push_back(candidate);
    if (!one.held.empty() || !one.evidence.empty()) out.push_back(std::move(one));
  }
  return out;
}

/// Probability of each effect of the evidence: at most one of them acts beside what the model
/// holds.
std::map<std::string, double> chances(const Told& arm, const Counts& counts) {
  std::map<std::string, double> out;
  double largest = 0.0, sum = 0.0;
  for (const auto& one : arm.evidence)
    largest =
        std::max(largest, out[one.effect] = std::log(counts.at(one.effect).odds()) + one.ln_bayes);
  for (auto& [effect, weight] : out) sum += weight = std::exp(weight - largest);
  sum += std::exp(-largest);  // none of them
  for (auto& [effect, weight] : out) weight /= sum;
  return out;
}

}  // namespace

std::vector<EffectShare> learn_shares(const std::vector<const CellSummary*>& arms) {
  const std::vector<Told> all = told_by(arms);
  if (all.size() < static_cast<std::size_t>(kFewestArms)) return {};
  Counts counts;
  for (const Told& arm : all) {
    for (const auto& effect : arm.held) counts.try_emplace(effect);
    for (const auto& one : arm.evidence) counts.try_emplace(one.effect);
  }
  for (int step = 0; step < kSteps; ++step) {
    Counts next;
    for (const Told& arm : all) {
      const auto found = chances(arm, counts);
      for (const auto& [effect, ignored] : counts) {
        const auto at = found.find(effect);
        const double chance = arm.held.contains(effect) ? 1.0
                              : at != found.end()       ? at->second
                                                        : 0.0;
        Count& count = next[effect];
        if (!arm.says(effect)) continue;
        count.have += chance;
        count.have_not += 1.0 - chance;
      }
    }
    counts = std::move(next);
  }
  std::vector<EffectShare> out;
  for (const auto& [effect, count] : counts)
    out.push_back({.effect = effect,
                   .arms = count.have,
                   .of = count.have + count.have_not,
                   .odds_nats = std::log(count.odds()) - std::log(kHave / kHaveNot)});
  return out;
}

}  // namespace plumb::offline::fleet
