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

/// The group that grows as long as the evidence of a further joint exceeds its price, even if that
/// joint explains little.
Found by_evidence_alone(const Scorer& scorer, const std::vector<const Found*>& single) {
  Found out = *single.front();
  while (auto larger = with_one_more(scorer, out, single, -1.0)) out = std::move(*larger);
  return out;
}

/// All joints of the law that carry a load, together.
Found all_joints(const Scorer& scorer, const std::vector<const Found*>& single) {
  EffectEntry entry = single.front()->entry;
  for (const Found* other : single)
    if (other->entry.options == entry.options &&
        std::find(entry.joints.begin(), entry.joints.end(), other->entry.joints.front()) ==
            entry.joints.end())
      entry.joints.push_back(other->entry.joints.front());
  std::sort(entry.joints.begin(), entry.joints.end());
  const Regressor regressor = library_regressor(scorer.whitened(), entry);
  Found out{entry, {}, scorer.score(regressor), {}, 0.0, {}, 0.0};
  out.score = single.front()->score + out.ln_bayes() - single.front()->ln_bayes();
  return out;
}

/// Joints that yield together, of which each but one moves too little to be added by itself, look
/// like a law of another cause: a link that bends. They are put into one candidate if that explains
/// more than the other law, by a clear margin.
std::optional<Found> against_another_cause(const Scorer& scorer, const EffectDescriptor& effect,
                                           const std::vector<const Found*>& single,
                                           const std::optional<Found>& group,
                                           const Found& strongest) {
  const double own = group ? group->ln_bayes() : single.front()->ln_bayes();
  if (effect.cause != Cause::kYieldingJoint || strongest.ln_bayes() <= own ||
      descriptor_of(strongest.entry.name).cause == effect.cause)
    return std::nullopt;
  Found best = by_evidence_alone(scorer, single);
  if (Found all = all_joints(scorer, single); all.ln_bayes() > best.ln_bayes() + kSupported)
    best = std::move(all);
  if (best.ln_bayes() < strongest.ln_bayes() + kSupported) return std::nullopt;
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
    while (group) {
      auto larger = with_one_more(scorer, *group, single, least);
      if (!larger) break;
      group = std::move(larger);
    }
    if (auto wider = against_another_cause(scorer, *effect, single, group, library.front()))
      group = std::move(wider);
    if (group) out.push_back(std::move(*group));
  }
  return out;
}

}  // namespace plumb::offline
