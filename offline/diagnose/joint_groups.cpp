// SPDX-License-Identifier: Apache-2.0
#include "diagnose/joint_groups.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/constants.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

/// The group with one more joint, if the evidence supports any.
std::optional<Found> with_one_more(const Scorer& scorer, const Found& group,
                                   const std::vector<const Found*>& others, double least) {
  std::optional<Found> best;
  for (const Found* other : others) {
    const int joint = other->entry.joints.front();
    EffectEntry entry = group.entry;
    if (std::find(entry.joints.begin(), entry.joints.end(), joint) != entry.joints.end() ||
        entry.options != other->entry.options)
      continue;
    entry.joints.push_back(joint);
    std::sort(entry.joints.begin(), entry.joints.end());
    const Regressor regressor = library_regressor(scorer.whitened(), entry);
    Found found{entry, {}, scorer.score(regressor), {}, 0.0, {}, 0.0};
    if (found.scored.explained - group.scored.explained < least &&
        !reaches_noise(scorer.whitened(), found.scored))
      continue;
    const double price = kSupported + std::log(static_cast<double>(others.size()));
    if (found.ln_bayes() < group.ln_bayes() + price) continue;
    found.score = group.score + found.ln_bayes() - group.ln_bayes() - price + kSupported;
    if (!best || found.ln_bayes() > best->ln_bayes()) best = std::move(found);
  }
  return best;
}

}  // namespace

std::vector<Found> joint_groups(const Scorer& scorer, const std::vector<Found>& library) {
  std::vector<Found> out;
  for (const EffectDescriptor* effect : effect_descriptors()) {
    if (effect->group_share == 0.0) continue;
    std::vector<const Found*> single;  // best first
    for (const auto& found : library)
      if (found.entry.name == effect->name) single.push_back(&found);
    if (single.size() < 2 || single.front()->score <= kSupported) continue;
    const double least =
        effect->group_share * effect->group_share * single.front()->scored.explained;
    std::optional<Found> group = with_one_more(scorer, *single.front(), single, least);
    if (!group) continue;
    while (auto larger = with_one_more(scorer, *group, single, least)) group = std::move(larger);
    out.push_back(std::move(*group));
  }
  return out;
}

}  // namespace plumb::offline
