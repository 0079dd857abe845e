// SPDX-License-Identifier: Apache-2.0
#include "diagnose/joint_groups.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace plumb::offline {
namespace {

/// An effect, and how far another joint must move the point, as a share of the best one. What adds
/// less is left to the next look, unless both together leave only noise: it may be something else.
/// More than 1: only then.
struct Several {
  std::string_view effect;
  double least;
};
constexpr std::array kAtSeveralJoints = {Several{"joint_compliance", 0.3},
                                         Several{"gravity_free", 0.3}, Several{"link_flexure", 1.5},
                                         Several{"gear_harmonics", 0.7}};

/// The group with one more joint, if the evidence supports any.
std::optional<Found> with_one_more(const Judge& judge, const Found& group,
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
    const Block block = library_block(judge.stage(), entry);
    Found found{entry, {}, judge.judge(block), {}, 0.0, {}, 0.0};
    if (found.trial.explained - group.trial.explained < least &&
        !reaches_noise(judge.stage(), found.trial))
      continue;
    const double price = kSupported + std::log(static_cast<double>(others.size()));
    if (found.ln_bayes() < group.ln_bayes() + price) continue;
    found.score = group.score + found.ln_bayes() - group.ln_bayes() - price + kSupported;
    if (!best || found.ln_bayes() > best->ln_bayes()) best = std::move(found);
  }
  return best;
}

}  // namespace

std::vector<Found> joint_groups(const Judge& judge, const std::vector<Found>& library) {
  std::vector<Found> out;
  for (const auto& [name, share] : kAtSeveralJoints) {
    std::vector<const Found*> single;  // best first
    for (const auto& found : library)
      if (found.entry.name == name) single.push_back(&found);
    if (single.size() < 2 || single.front()->score <= kSupported) continue;
    const double least = share * share * single.front()->trial.explained;
    std::optional<Found> group = with_one_more(judge, *single.front(), single, least);
    if (!group) continue;
    while (auto larger = with_one_more(judge, *group, single, least)) group = std::move(larger);
    out.push_back(std::move(*group));
  }
  return out;
}

}  // namespace plumb::offline
