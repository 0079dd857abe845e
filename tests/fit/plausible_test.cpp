// SPDX-License-Identifier: Apache-2.0
#include "fit/plausible.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/constants.hpp"

namespace plumb::offline {
namespace {

constexpr EffectParameter kFree{"c", "rad", 1e-3, 0.0, 0.0};
constexpr EffectParameter kSpring{"c", "rad/Nm", 1e-6, 0.0, 1.0};
constexpr EffectParameter kAnySize{"c", "rad", 0.0, 0.0, 0.0};

TEST(Plausible, TheSizeIsThatInUnitsOfTheUsualOneOfEitherSign) {
  for (const double times : {0.0, 0.3, 1.0, 7.0, 400.0}) {
    EXPECT_NEAR(times_usual(times * kFree.typical, 0.0, kFree), times, 1e-12 * (1.0 + times));
    EXPECT_EQ(times_usual(times * 1e-3, 1e-4, kFree), times_usual(-times * 1e-3, 1e-4, kFree));
  }
}

TEST(Plausible, AnUncertainNumberIsNeverLargerForCertain) {
  double before = std::numeric_limits<double>::infinity();
  for (double std = 0.0; std < 0.05; std += 1e-3) {
    const double now = times_usual(0.04, std, kFree);
    EXPECT_LE(now, before);
    EXPECT_GE(now, 0.0);
    before = now;
  }
  EXPECT_EQ(before, 0.0) << "nothing is certain of it";
}

TEST(Plausible, TheLimitIsTwentyTimesTheUsualSizeOfEitherSign) {
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(plausible(sign * 0.999 * kMostTimesUsual * 1e-3, 0.0, kFree));
    EXPECT_FALSE(plausible(sign * 1.001 * kMostTimesUsual * 1e-3, 0.0, kFree));
  }
}

TEST(Plausible, WhatItsLawRulesOutIsNotSaidWhereThreeSigmaReachTheBound) {
  EXPECT_TRUE(plausible(0.0, 0.0, kSpring));
  EXPECT_FALSE(plausible(-3.1e-7, 1e-7, kSpring)) << "a spring that pushes";
  EXPECT_TRUE(plausible(-2.9e-7, 1e-7, kSpring));
}

TEST(Plausible, WithoutAUsualSizeAnyFiniteSizeIsPlausible) {
  for (const double value : {-1e9, 0.0, 1e9}) {
    EXPECT_EQ(times_usual(value, 0.0, kAnySize), 0.0);
    EXPECT_TRUE(plausible(value, 0.0, kAnySize));
  }
}

TEST(Plausible, ANumberThatIsNoneIsNotPlausible) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const EffectParameter& info : {kFree, kSpring, kAnySize}) {
    EXPECT_FALSE(plausible(nan, 0.0, info));
    EXPECT_FALSE(plausible(std::numeric_limits<double>::infinity(), 0.0, info));
    EXPECT_FALSE(plausible(0.0, nan, info));
  }
}

}  // namespace
}  // namespace plumb::offline
