// SPDX-License-Identifier: Apache-2.0
#include "fleet/effect_shares.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "fleet/typical.hpp"

namespace plumb::offline::fleet {
namespace {

constexpr double kNothing = 10.0, kOne = 0.5;  // weights beforehand, in arms: some 20 effects
constexpr int kSteps = 100;

struct Counts {
  double nothing = 0.0;
  std::map<std::string, double> effects;
};

/// Adds to `next` the probabilities that nothing, or which effect, acts in an arm.
void add_arm(const CellDiagnosis& arm, const Counts& now, Counts& next) {
  const double ln_nothing = std::log(now.nothing + kNothing);
  double largest = ln_nothing;
  std::vector<double> weight;  // first its logarithm
  for (const auto& one : arm.evidence) {
    weight.push_back(std::log(now.effects.at(one.effect) + kOne) + one.ln_bayes);
    largest = std::max(largest, weight.back());
  }
  const double nothing = std::exp(ln_nothing - largest);
  double sum = nothing;
  for (double& one : weight) sum += one = std::exp(one - largest);
  next.nothing += nothing / sum;
  for (std::size_t i = 0; i < weight.size(); ++i)
    next.effects.at(arm.evidence[i].effect) += weight[i] / sum;
}

}  // namespace

EffectShares learn_shares(const std::vector<const CellSummary*>& arms) {
  std::vector<const CellDiagnosis*> told;
  Counts none;
  for (const auto* arm : arms) {
    if (!arm->diagnosis || arm->diagnosis->evidence.empty()) continue;
    told.push_back(&*arm->diagnosis);
    for (const auto& one : arm->diagnosis->evidence) none.effects.emplace(one.effect, 0.0);
  }
  EffectShares out;
  out.diagnosed = static_cast<int>(told.size());
  if (out.diagnosed < kFewestArms) return out;
  Counts counts = none;
  for (int step = 0; step < kSteps; ++step) {
    Counts next = none;
    for (const auto* arm : told) add_arm(*arm, counts, next);
    counts = std::move(next);
  }
  for (const auto& [effect, n] : counts.effects)
    out.effects.push_back({.effect = effect,
                           .arms = n,
                           .odds_nats = std::log((n + kOne) / (counts.nothing + kNothing)) -
                                        std::log(kOne / kNothing)});
  return out;
}

}  // namespace plumb::offline::fleet
