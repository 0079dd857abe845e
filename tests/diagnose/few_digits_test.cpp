// SPDX-License-Identifier: Apache-2.0
#include "diagnose/few_digits.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

TEST(FewDigits, RoundedOnceOrTwiceIsTheSame) {
  tests::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double value = std::pow(10.0, random.uniform(-9.0, 9.0));
    const double once = three_digits(value);
    EXPECT_NEAR(three_digits(once), once, 1e-15 * once);
    EXPECT_NEAR(five_digits(once), once, 1e-15 * once);
  }
}

TEST(FewDigits, TheErrorIsAtMostHalfAUnitOfTheLastDigit) {
  tests::Random random(2);
  for (int i = 0; i < 200; ++i) {
    const double value = random.uniform(1.0, 10.0);
    EXPECT_LE(std::abs(three_digits(value) - value), 0.5e-2 + 1e-15);
    EXPECT_LE(std::abs(five_digits(value) - value), 0.5e-4 + 1e-15);
  }
}

TEST(FewDigits, SignAndPowersOfTenStayOutsideOfTheRounding) {
  for (const double value : {1.2345, 9.996, 5.0}) {
    EXPECT_EQ(three_digits(-value), -three_digits(value));
    for (const double ten : {1e-6, 1e-2, 1e3, 1e7})
      EXPECT_NEAR(three_digits(value * ten), three_digits(value) * ten, 1e-14 * value * ten);
  }
}

TEST(FewDigits, WhatHasNoDigitsStaysAsItIs) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(three_digits(0.0), 0.0);
  EXPECT_EQ(three_digits(infinity), infinity);
  EXPECT_EQ(three_digits(-infinity), -infinity);
  EXPECT_TRUE(std::isnan(three_digits(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace plumb::offline
