// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "plumb/runtime/context_inputs.hpp"
#include "plumb/runtime/detail/last_move.hpp"

namespace plumb {
namespace {

constexpr double kBand = 1e-3;

LastMove::Joints bands() {
  LastMove::Joints out{};
  out.fill(kBand);
  return out;
}

/// One joint led along these positions.
class Joint {
 public:
  Joint& to(double q) {
    move_.follow(std::span(&q, 1));
    return *this;
  }
  Joint& change_source() {
    move_.change_source();
    return *this;
  }
  double direction() const { return move_.direction(0); }
  double travel() const { return move_.travel(0); }

 private:
  LastMove move_{bands()};
};

TEST(LastMove, IsUnknownUntilTheFirstMoveBeyondTheDeadBand) {
  Joint joint;
  EXPECT_TRUE(std::isnan(joint.direction()));
  joint.to(0.5).to(0.5 + 0.9 * kBand).to(0.5 - 0.9 * kBand);
  EXPECT_TRUE(std::isnan(joint.direction()));
  EXPECT_TRUE(std::isnan(joint.travel()));
  joint.to(0.5 - 1.1 * kBand);
  EXPECT_EQ(joint.direction(), -1.0);
  EXPECT_NEAR(joint.travel(), 1.1 * kBand, 1e-15);
}

TEST(LastMove, IsHeldAtRestAndThroughNoiseWithinTheDeadBand) {
  Joint joint;
  joint.to(0.0).to(0.2);
  for (int k = 0; k < 1000; ++k) {
    joint.to(0.2 - (k % 2 == 0 ? 0.9 : 0.1) * kBand);
    ASSERT_EQ(joint.direction(), 1.0);
    ASSERT_EQ(joint.travel(), 0.2);
  }
}

TEST(LastMove, TurnsOnceItCameBackByMoreThanTheDeadBandHoweverSlowly) {
  Joint joint;
  joint.to(0.0).to(0.2);
  int steps = 0;
  for (double q = 0.2; joint.direction() > 0.0; q -= 1e-5, ++steps) joint.to(q);
  EXPECT_NEAR(steps, kBand / 1e-5, 3.0);
  EXPECT_NEAR(joint.travel(), kBand, 2e-5);
}

TEST(LastMove, CountsTheWholeWaySinceTheTurn) {
  Joint joint;
  joint.to(0.0).to(0.1).to(0.1).to(0.3).to(0.25).to(0.1);
  EXPECT_EQ(joint.direction(), -1.0);
  EXPECT_NEAR(joint.travel(), 0.2, 1e-15);
}

TEST(LastMove, TakesTheWayBetweenTwoSourcesForNoMove) {
  Joint joint;
  joint.to(0.0).to(0.3).change_source().to(0.1);
  EXPECT_EQ(joint.direction(), 1.0);
  EXPECT_NEAR(joint.travel(), 0.3, 1e-15);
  joint.to(0.2);
  EXPECT_NEAR(joint.travel(), 0.4, 1e-15);
  joint.to(0.1);
  EXPECT_EQ(joint.direction(), -1.0);
}

TEST(LastMove, SkipsPositionsThatAreNone) {
  Joint joint;
  joint.to(0.0).to(0.3);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e308, -1e5}) {
    joint.to(bad);
    EXPECT_EQ(joint.direction(), 1.0);
    EXPECT_EQ(joint.travel(), 0.3);
  }
}

/// The same from the whole record, backwards: where was the last turn?
double direction_of(const std::vector<double>& record) {
  double direction = 0.0, farthest = record.front();
  for (const double q : record) {
    if (direction == 0.0 && std::abs(q - farthest) > kBand) {
      direction = q > farthest ? 1.0 : -1.0;
      farthest = q;
    } else if (direction > 0.0) {
      farthest = std::max(farthest, q);
      if (farthest - q > kBand) direction = -1.0, farthest = q;
    } else if (direction < 0.0) {
      farthest = std::min(farthest, q);
      if (q - farthest > kBand) direction = 1.0, farthest = q;
    }
  }
  return direction;
}

TEST(LastMove, AgreesWithTheWholeRecordOnRandomWalks) {
  std::mt19937_64 engine(11);
  std::normal_distribution<double> step(0.0, 0.6 * kBand);
  for (int walk = 0; walk < 100; ++walk) {
    Joint joint;
    std::vector<double> record{0.0};
    joint.to(0.0);
    for (int k = 0; k < 200; ++k) {
      record.push_back(record.back() + step(engine));
      joint.to(record.back());
      const double direction = std::isnan(joint.direction()) ? 0.0 : joint.direction();
      ASSERT_EQ(direction, direction_of(record)) << walk << " " << k;
    }
  }
}

Context context_of(const ContextInputs& inputs) { return inputs.context(LastMove(bands()), 6); }

TEST(ContextInputs, KnowNothingBeforeAnythingCame) {
  ContextInputs inputs({});
  inputs.step({}, 0.004);
  const Context context = context_of(inputs);
  EXPECT_TRUE(std::isnan(context.payload_kg));
  EXPECT_TRUE(std::isnan(context.time_s));
  for (const double t : context.temperature_degC) EXPECT_TRUE(std::isnan(t));
  for (const double d : context.direction) EXPECT_TRUE(std::isnan(d));
}

TEST(ContextInputs, GoByAReadingUntilItIsTooOld) {
  ContextInputs inputs({.temperature_s = 1.0});
  ContextReadings came;
  came.temperature_degC[3] = {31.5, 0.2};
  inputs.step(came, 0.1);
  for (int k = 0; k < 8; ++k) {
    EXPECT_EQ(context_of(inputs).temperature_degC[3], 31.5) << k;
    EXPECT_TRUE(std::isnan(context_of(inputs).temperature_degC[2]));
    inputs.step({}, 0.1);
  }
  inputs.step({}, 0.1);
  EXPECT_TRUE(std::isnan(context_of(inputs).temperature_degC[3]));
  inputs.step(came, 0.1);
  EXPECT_EQ(context_of(inputs).temperature_degC[3], 31.5);
}

TEST(ContextInputs, HoldAPayloadUntilTheNextOne) {
  ContextInputs inputs({});
  ContextReadings came;
  came.payload_kg = {12.0, 0.0};
  came.payload_com_m = {0.0, 0.01, 0.1};
  inputs.step(came, 0.004);
  inputs.step({}, 1e7);
  EXPECT_EQ(context_of(inputs).payload_kg, 12.0);
  EXPECT_EQ(context_of(inputs).payload_com_m[2], 0.1);
}

TEST(ContextInputs, LetTheProcessTimeRunOnByItself) {
  ContextInputs inputs({.time_s = 10.0});
  ContextReadings came;
  came.time_s = {100.0, 0.5};
  inputs.step(came, 0.004);
  EXPECT_EQ(context_of(inputs).time_s, 100.5);
  inputs.step({}, 2.0);
  EXPECT_EQ(context_of(inputs).time_s, 102.5);
  inputs.step({}, 8.0);
  EXPECT_TRUE(std::isnan(context_of(inputs).time_s));
}

TEST(ContextInputs, TakeWhatIsNoReadingForUnknown) {
  ContextInputs inputs({});
  const double wrong[] = {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e308, -1e13};
  ContextReadings good, bad;
  good.payload_kg = {5.0, 0.0};
  for (const double value : wrong) {
    bad.payload_kg = {value, 0.0};
    inputs.step(good, 0.004);
    EXPECT_EQ(context_of(inputs).payload_kg, 5.0);
    inputs.step(bad, 0.004);
    EXPECT_TRUE(std::isnan(context_of(inputs).payload_kg)) << value;
  }
  for (const double age : {HUGE_VAL, -1e-9, -HUGE_VAL}) {
    bad.payload_kg = {5.0, age};
    inputs.step(good, 0.004);
    inputs.step(bad, 0.004);
    EXPECT_TRUE(std::isnan(context_of(inputs).payload_kg)) << age;
  }
}

TEST(ContextInputs, AllowNothingUnderALimitThatIsNoNumber) {
  ContextInputs inputs({.payload_s = std::nan(""), .temperature_s = -1.0});
  ContextReadings came;
  came.payload_kg = {5.0, 0.0};
  came.temperature_degC[0] = {25.0, 0.0};
  inputs.step(came, 0.004);
  EXPECT_TRUE(std::isnan(context_of(inputs).payload_kg));
  EXPECT_TRUE(std::isnan(context_of(inputs).temperature_degC[0]));
}

TEST(CycleTime, AgesInputsAlsoUnderAClockThatStandsOrRunsBackwards) {
  CycleTime time;
  EXPECT_EQ(time.tick(5'000'000, 0.004).dt_s, 0.0);
  EXPECT_NEAR(time.tick(9'000'000, 0.004).dt_s, 0.004, 1e-15);
  EXPECT_EQ(time.tick(9'000'000, 0.004).dt_s, 0.0);
  EXPECT_EQ(time.tick(9'000'000, 0.004).ageing_s, 0.004);
  EXPECT_EQ(time.tick(-1, 0.004).ageing_s, 0.004);
  EXPECT_EQ(time.tick(INT64_MIN, 0.004).dt_s, 0.0);
  EXPECT_NEAR(time.tick(INT64_MAX, 0.004).dt_s, 1.8446744073709552e10, 1.0);
}

}  // namespace
}  // namespace plumb
