// SPDX-License-Identifier: Apache-2.0
#include "solve/predictions_at_rest.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solve/constants.hpp"

namespace plumb::offline {
namespace {

constexpr int kResiduals = 300;

/// Costs near the noise that fall by the same amount with every iteration.
PredictionsAtRest falling_by(double each, int iterations) {
  PredictionsAtRest out(kResiduals);
  for (int i = 0; i <= iterations; ++i) out.add(0.5 * kResiduals + each * (iterations - i));
  return out;
}

/// The fall of the cost over the iterations looked at that moves the predictions by so much.
double fall_of(double motion) { return 0.5 * kResiduals * motion * motion; }

TEST(PredictionsAtRest, AFitMayEndOnceTheLastIterationsMovedThePredictionsByLessThanTheLimit) {
  const double look_back = kRestLookBack;
  const int many = static_cast<int>(kRestPatience);
  EXPECT_TRUE(falling_by(0.8 * fall_of(kAtRest) / look_back, many).may_end());
  EXPECT_FALSE(falling_by(1.2 * fall_of(kAtRest) / look_back, many).may_end());
  EXPECT_TRUE(falling_by(0.8 * fall_of(kNearlyAtRest) / look_back, many).nearly());
  EXPECT_FALSE(falling_by(1.2 * fall_of(kNearlyAtRest) / look_back, many).nearly());
}

TEST(PredictionsAtRest, AFitThatHasJustBegunIsNotAtRestWhateverItsCosts) {
  EXPECT_FALSE(falling_by(0.0, static_cast<int>(kRestPatience) - 1).may_end());
  EXPECT_TRUE(falling_by(0.0, static_cast<int>(kRestPatience)).may_end());
  EXPECT_FALSE(falling_by(0.0, static_cast<int>(kRestLookBack) - 1).nearly());
  EXPECT_TRUE(falling_by(0.0, static_cast<int>(kRestLookBack)).nearly());
}

/// Motions count in standard deviations of what scatters: of the residuals, where these are larger
/// than the noise.
TEST(PredictionsAtRest, OfAModelThatMissesByMoreThanTheNoiseAsMuchMoreMotionIsRest) {
  const double times = 10.0, each = 1.5 * fall_of(kNearlyAtRest) / kRestLookBack;
  PredictionsAtRest misses(kResiduals);
  for (int i = 0; i < 20; ++i) misses.add(times * times * 0.5 * kResiduals + each * (20 - i));
  EXPECT_FALSE(falling_by(each, 20).nearly());
  EXPECT_TRUE(misses.nearly());
}

TEST(PredictionsAtRest, ACostThatIsNotFiniteIsNoRest) {
  PredictionsAtRest lost(kResiduals);
  for (int i = 0; i < 100; ++i) lost.add(std::nan(""));
  EXPECT_FALSE(lost.may_end());
  EXPECT_FALSE(lost.nearly());
}

}  // namespace
}  // namespace plumb::offline
