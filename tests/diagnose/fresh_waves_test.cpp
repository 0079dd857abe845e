// SPDX-License-Identifier: Apache-2.0
// Waves of a joint that were found one after another are searched for again together.
#include "diagnose/fresh_waves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/effect_option.hpp"
#include "effects/registry.hpp"
#include "tests/diagnose/begun.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

EffectEntry wave_at(int joint, double cycles) {
  EffectEntry out = entry_of(wave_effect(), {joint});
  set_option(out, OptionKey::kCyclesPerTurn, cycles);
  return out;
}

/// The gear of the third joint has two waves, of which the selection has added one, a little
/// beside its place; or has what the cell gives it.
struct FreshWaves : testing::Test {
  static constexpr int kJoint = 2;
  static constexpr double kSlow = 7.0, kFast = 21.0;

  FreshWaves() {
    Measurements& m = blind.measured.measured;
    for (Eigen::Index i = 0; i < m.q.rows(); ++i)
      m.q(i, kJoint) -=
          2e-4 * std::sin(kSlow * m.q(i, kJoint)) + 2e-4 * std::cos(kFast * m.q(i, kJoint) + 1.0);
  }
  static Found best_of(const Selection& s, int joint) {
    const Found* const found = s.look().find(s.cell(), s.key(wave_at(joint, 1.0)));
    EXPECT_NE(found, nullptr);
    return found == nullptr ? Found() : *found;
  }
  static bool has_near(const std::vector<double>& cycles, double one) {
    return std::any_of(cycles.begin(), cycles.end(),
                       [&](double c) { return std::abs(c - one) < 0.2; });
  }
  BlindCase blind = healthy_arm(120);
};

TEST_F(FreshWaves, ReplaceThoseThatWereFoundWhileOthersWereMissing) {
  Selection s = having_added(blind, {wave_at(kJoint, kSlow + 0.4)});
  const Found best = best_of(s, kJoint);
  const Found fresh = with_fresh_waves(s, best);
  EXPECT_TRUE(has_near(fresh.cycles, kSlow)) << "where it is, not where it was";
  EXPECT_TRUE(has_near(fresh.cycles, kFast));
  EXPECT_EQ(s.key(fresh.entry), s.key(best.entry));
  EXPECT_TRUE(keys_in(s).empty()) << "they are yet to be added, together";
  EXPECT_TRUE(s.added.empty());
  EXPECT_TRUE(s.look().find(s.cell(), s.key(fresh.entry)) != nullptr);
}

TEST_F(FreshWaves, AreSearchedForOnce) {
  Selection s = having_added(blind, {wave_at(kJoint, kSlow + 0.4)});
  const Found best = best_of(s, kJoint);
  ASSERT_TRUE(s.first_time("fresh waves", s.key(best.entry)));
  const Found same = with_fresh_waves(s, best);
  EXPECT_EQ(same.cycles, best.cycles);
  EXPECT_EQ(keys_in(s).size(), 1U);
}

TEST_F(FreshWaves, OfAnotherJointOrOtherEffectsChangeNothing) {
  Selection s = having_added(blind, {wave_at(kJoint, kSlow)});
  Found gear;
  gear.entry = entry_of("gear_harmonics", {kJoint});
  for (const Found& best : {best_of(s, 0), best_of(s, 4), gear}) {
    const Found same = with_fresh_waves(s, best);
    EXPECT_EQ(s.key(same.entry), s.key(best.entry));
    EXPECT_EQ(same.cycles, best.cycles);
    EXPECT_EQ(same.ln_bayes(), best.ln_bayes());
    EXPECT_EQ(keys_in(s).size(), 1U);
    EXPECT_EQ(s.added.size(), 1U);
  }
}

TEST_F(FreshWaves, ThoseThatTheUserGaveStay) {
  Cell cell = blind.cell;
  cell.effects.push_back(wave_at(kJoint, kSlow));
  Selection s = begun(blind, cell);
  const Found best = best_of(s, kJoint);
  EXPECT_EQ(with_fresh_waves(s, best).cycles, best.cycles);
  ASSERT_EQ(s.cell().effects.size(), cell.effects.size());
  EXPECT_EQ(number_option(s.cell().effects.back(), OptionKey::kCyclesPerTurn, 0.0), kSlow);
}

}  // namespace
}  // namespace plumb::offline
