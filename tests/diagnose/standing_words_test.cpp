// SPDX-License-Identifier: Apache-2.0
// How an arm stands, as gravity in its base frame says it.
#include "diagnose/other_gravity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plumb::offline {
namespace {

/// Gravity of 9.81 m/s^2 on an arm that is tilted so far, towards a heading.
std::array<double, 3> tilted(double tilt_deg, double heading_deg) {
  const double a = tilt_deg * std::numbers::pi / 180.0, h = heading_deg * std::numbers::pi / 180.0;
  return {9.81 * std::sin(a) * std::cos(h), 9.81 * std::sin(a) * std::sin(h), -9.81 * std::cos(a)};
}

TEST(StandingWords, DependOnTheTiltAloneAndNotOnTheHeadingNorOnTheSize) {
  for (const double tilt : {0.0, 12.0, 45.0, 90.0, 130.0, 180.0})
    for (double heading = 0.0; heading < 360.0; heading += 30.0) {
      std::array<double, 3> gravity = tilted(tilt, heading);
      EXPECT_EQ(standing_words(gravity), standing_words(tilted(tilt, 0.0))) << tilt;
      for (double& g : gravity) g *= 0.17;  // on the Moon
      EXPECT_EQ(standing_words(gravity), standing_words(tilted(tilt, 0.0))) << tilt;
    }
}

TEST(StandingWords, NameTheUsualWaysToMountAnArm) {
  EXPECT_EQ(standing_words({0.0, 0.0, -9.81}), "the arm seems to stand upright");
  EXPECT_EQ(standing_words({0.0, 0.0, 9.81}), "the arm seems to hang from a ceiling");
  for (const double sign : {-9.81, 9.81}) {
    EXPECT_EQ(standing_words({sign, 0.0, 0.0}), "the arm seems to hang on a wall");
    EXPECT_EQ(standing_words({0.0, sign, 0.0}), "the arm seems to hang on a wall");
  }
}

TEST(StandingWords, SayTheTiltInBetween) {
  for (const int tilt : {3, 10, 45, 84, 96, 140, 174})
    EXPECT_EQ(standing_words(tilted(tilt, 20.0)),
              "the arm seems to be tilted by " + std::to_string(tilt) + " deg");
}

}  // namespace
}  // namespace plumb::offline
