// SPDX-License-Identifier: Apache-2.0
// What else may yield where the cell states no mass.
#include "diagnose/unknown_weights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "diagnose/constants.hpp"
#include "effects/registry.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

struct RivalsUnderUnknownWeights : testing::Test {
  RivalsUnderUnknownWeights() {
    for (JointMechanics& link : weightless.mechanics) {
      link.link_mass_kg.reset();
      link.kg_per_m.reset();
    }
  }
  /// The fit of a cell that states no mass, which leaves this law under the true weights.
  WhitenedFit yielding(const EffectEntry& law, double size, bool states_masses = false) const {
    WhitenedFit out =
        leaving(arm, noise_of(arm, 81) + motion_of_size(arm, library_regressor(arm, law), size));
    if (!states_masses) out.cell = &weightless;
    return out;
  }
  static Found candidate(const WhitenedFit& s, const EffectEntry& entry) {
    return {entry, {}, Scorer(s).score(library_regressor(s, entry)), {}, 0.0, {}, 0.0};
  }
  static bool names(const std::vector<Found>& found, const std::string& effect) {
    return std::any_of(found.begin(), found.end(),
                       [&](const Found& one) { return one.entry.name == effect; });
  }

  const WhitenedFit& arm = whitened_arm().whitened;
  Cell weightless = whitened_arm().blind.cell;
  EffectEntry base = entry_of("base_compliance"), joint = entry_of("joint_compliance", {1});
};

TEST_F(RivalsUnderUnknownWeights, TheLawThatIsThereIsAmongTheRivalsOfOneThatImitatesIt) {
  const WhitenedFit s = yielding(base, 20.0);
  const Found first = candidate(s, joint);
  const auto rivals = rivals_under_unknown_weights(s, first);
  EXPECT_TRUE(names(rivals, base.name));
  for (const Found& rival : rivals) EXPECT_NE(rival.entry.name, joint.name);
  ASSERT_FALSE(rivals.empty());
  EXPECT_GT(rivals.front().ln_bayes(), first.ln_bayes()) << "it is explained better";
}

TEST_F(RivalsUnderUnknownWeights, RivalsAreNearTheBestOfThemEachLawOnceAndTheBestFirst) {
  for (const EffectEntry& law : {base, joint, entry_of("link_flexure", {2})}) {
    const WhitenedFit s = yielding(law, 3.0);
    const Found first = candidate(s, joint);
    const auto rivals = rivals_under_unknown_weights(s, first);
    double before = HUGE_VAL, best = first.ln_bayes();
    if (!rivals.empty()) best = std::max(best, rivals.front().ln_bayes());
    std::set<std::string> laws;
    for (const Found& rival : rivals) {
      EXPECT_LE(rival.ln_bayes(), before);
      before = rival.ln_bayes();
      EXPECT_GE(rival.ln_bayes(), best - kTold_nats - 1e-9);
      EXPECT_TRUE(laws.insert(rival.entry.name).second) << rival.entry.name;
    }
  }
}

TEST_F(RivalsUnderUnknownWeights, ThereAreNoneWhereAMassIsStated) {
  const WhitenedFit stated = yielding(base, 4.0, true);
  EXPECT_TRUE(rivals_under_unknown_weights(stated, candidate(stated, joint)).empty());
}

/// Neither weight makes a thing happen again with every turn of a gear, or with time.
TEST_F(RivalsUnderUnknownWeights, WhatDoesNotDependOnThePoseAloneHasNone) {
  const WhitenedFit s = yielding(base, 4.0);
  EXPECT_FALSE(rivals_under_unknown_weights(s, candidate(s, joint)).empty());
  EffectEntry wave = entry_of(wave_effect(), {1});
  set_option(wave, OptionKey::kCyclesPerTurn, 7.0);
  EXPECT_TRUE(rivals_under_unknown_weights(s, candidate(s, wave)).empty());
  EXPECT_TRUE(rivals_under_unknown_weights(s, candidate(s, entry_of("drift"))).empty());
  Found slow;
  slow.pattern = {"the tool frame", "drifts", {"t"}, 0.0, true};
  EXPECT_TRUE(rivals_under_unknown_weights(s, slow).empty());
}

/// Weights that nobody knows are no explanation of an error that is not there.
TEST_F(RivalsUnderUnknownWeights, NoiseHasNoRivalThatIsAheadOfIt) {
  const WhitenedFit s = yielding(base, 0.0);
  const Found first = candidate(s, joint);
  for (const Found& rival : rivals_under_unknown_weights(s, first))
    EXPECT_LT(rival.ln_bayes(), first.ln_bayes() + kSupported) << rival.entry.name;
}

}  // namespace
}  // namespace plumb::offline
