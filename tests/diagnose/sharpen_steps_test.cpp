// SPDX-License-Identifier: Apache-2.0
// Where something moved, found on every fourth reading and put right on all of them.
#include "diagnose/sharpen_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/effect_option.hpp"
#include "effects/registry.hpp"
#include "tests/diagnose/begun.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

/// A reflector that was bumped once, before row kBumped (from 0), which is 90 rows from both ends.
struct SharpenedSteps : testing::Test {
  static constexpr int kBumped = 90, kEvery = 4;

  SharpenedSteps() {
    Measurements& m = blind.measured.measured;
    for (Eigen::Index i = kBumped; i < m.p_M.rows(); ++i)
      m.p_M.row(i) += Eigen::RowVector3d(4e-4, -3e-4, 2e-4);
    all = all_rows(blind);
    for (std::size_t i = 0; i < all.size(); i += kEvery) choosing.push_back(all[i]);
  }
  /// A step of the base, as a selection that saw a few readings only would place it.
  static EffectEntry step_after(double row) {
    EffectEntry out = entry_of(change_point_effect());
    set_option(out, OptionKey::kOf, std::string("base"));
    set_option(out, OptionKey::kAfterRow, row);
    return out;
  }
  /// The one that is a step.
  static EffectEntry step_in(const std::vector<EffectEntry>& effects) {
    for (const EffectEntry& entry : effects)
      if (is_change_point(entry.name)) return entry;
    ADD_FAILURE() << "no step";
    return {};
  }
  static double place_of(const EffectEntry& entry) {
    return number_option(entry, OptionKey::kAfterRow, 0.0);
  }
  /// The last of these effects, beside those of the cell, is the step that is sharpened.
  ForwardStep sharpened(const std::vector<EffectEntry>& effects) const {
    Cell cell = blind.cell;
    cell.effects.insert(cell.effects.end(), effects.begin(), effects.end());
    ForwardStep step;
    step.entry = effects.back();
    step.effects = cell.effects;
    step.calibration = calibrate(cell, blind.measured.measured, choosing);
    std::vector<ForwardStep> steps{step};
    sharpen_steps(blind.cell, blind.measured.measured, {choosing, all}, steps);
    return steps.front();
  }

  BlindCase blind = healthy_arm(180);
  std::vector<int> all, choosing;
};

TEST_F(SharpenedSteps, EveryPlaceNearbyEndsWhereItMoved) {
  for (const int off : {-7, -3, 0, 2, 8}) {
    const ForwardStep step = sharpened({step_after(kBumped + off)});
    EXPECT_EQ(place_of(step.entry), kBumped) << off << ": the last row before it, from 1";
    ASSERT_EQ(step.effects.size(), blind.cell.effects.size() + 1) << off;
    EXPECT_EQ(place_of(step_in(step.effects)), kBumped) << "the model has the same place";
  }
}

/// A place that is wrong by more was not found on some of the readings, but by mistake.
TEST_F(SharpenedSteps, NoPlaceGoesFurtherThanAFewOfTheReadingsThatFoundIt) {
  for (const int off : {-60, 60}) {
    const double found = kBumped + off;
    const double now = place_of(sharpened({step_after(found)}).entry);
    EXPECT_LE(std::abs(now - found), 6.0 * kEvery) << off;
    EXPECT_GT(std::abs(now - kBumped), kEvery) << off;
  }
}

TEST_F(SharpenedSteps, OtherEffectsStayAsTheyAre) {
  const EffectEntry gear = entry_of("gear_harmonics", {1});
  const ForwardStep step = sharpened({gear, step_after(kBumped + 5)});
  EXPECT_EQ(place_of(step_in(step.effects)), kBumped);
  ASSERT_EQ(step.effects.size(), blind.cell.effects.size() + 2);
  EXPECT_TRUE(has_effect(step.effects, gear));
  for (const EffectEntry& own : blind.cell.effects) EXPECT_TRUE(has_effect(step.effects, own));
  const ForwardStep none = sharpened({step_after(kBumped + 5), gear});
  EXPECT_EQ(none.entry.name, gear.name);
  EXPECT_EQ(place_of(step_in(none.effects)), kBumped + 5) << "it is not the step that is asked for";
}

}  // namespace
}  // namespace plumb::offline
