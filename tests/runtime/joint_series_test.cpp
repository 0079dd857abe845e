// SPDX-License-Identifier: Apache-2.0
// A series of waves against the plain sum in long double, which shares no recurrence with it.
#include "plumb/runtime/detail/effects/joint_series.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "tests/random_numbers.hpp"

namespace plumb {
namespace {

using effects::JointSeries;
using tests::Random;

constexpr double kBound = 1e-12;  // of the sum of all numbers, as the header promises

/// What the law adds to the position of the one joint there is.
double moved(const std::vector<double>& numbers, double q) {
  const Chain chain{};
  const ChainFrames frames{};
  const Loads loads{};
  const Context context{};
  const std::array<double, 1> at{q};
  const std::array<std::uint8_t, 1> joints{0};
  const std::array<double, 3> constants{0.5 * static_cast<double>(numbers.size()), 1e-4, 1.0};
  const Situation situation{
      .q = at, .chain = chain, .frames = frames, .loads = loads, .context = context};
  Motion<double> out;
  JointSeries::apply<double>(numbers, {.arm_joints = 1, .joints = joints, .constants = constants},
                             situation, out);
  return out.dq[0];
}

long double plain_sum(const std::vector<double>& numbers, double q) {
  long double sum = 0.0L;
  for (std::size_t k = 0; k < numbers.size() / 2; ++k) {
    const long double angle = static_cast<long double>(k + 1) * static_cast<long double>(q);
    sum += static_cast<long double>(numbers[2 * k]) * std::sin(angle) +
           static_cast<long double>(numbers[2 * k + 1]) * std::cos(angle);
  }
  return sum;
}

double size_of(const std::vector<double>& numbers) {
  double sum = 0.0;
  for (const double x : numbers) sum += std::abs(x);
  return sum;
}

std::vector<double> random_numbers(Random& dice, int waves) {
  std::vector<double> out(2 * static_cast<std::size_t>(waves));
  for (double& x : out) x = dice.uniform(-3e-4, 3e-4);
  return out;
}

/// Everywhere, and where a recurrence in the cosine is worst: at half turns.
double random_angle(Random& dice) {
  constexpr double kHalfTurn = std::numbers::pi;
  switch (dice.below(4)) {
    case 0:
      return dice.uniform(-kHalfTurn, kHalfTurn);
    case 1:
      return dice.uniform(-1e4, 1e4);
    case 2:
      return std::round(dice.uniform(-4.0, 4.0)) * kHalfTurn;
    default:
      return std::round(dice.uniform(-4.0, 4.0)) * kHalfTurn +
             std::pow(10.0, dice.uniform(-16.0, -1.0));
  }
}

TEST(JointSeries, IsThePlainSumToItsBoundForEveryNumberOfWavesAndAnyAngle) {
  const long count = tests::scaled(200000);
  const std::uint64_t seed = 11;
  Random dice(seed);
  double worst = 0.0;
  for (long i = 0; i < count; ++i) {
    const int waves = 1 + dice.below(format::kMaxSeriesWaves);
    const auto numbers = random_numbers(dice, waves);
    const double q = random_angle(dice);
    const auto error = static_cast<double>(
        std::abs(static_cast<long double>(moved(numbers, q)) - plain_sum(numbers, q)));
    worst = std::max(worst, error / size_of(numbers));
  }
  std::printf("%ld sums, seed %lu: worst error %.1e of the sum of all numbers\n", count,
              static_cast<unsigned long>(seed), worst);
  EXPECT_LT(worst, kBound);
}

TEST(JointSeries, AFaultInOneOfItsNumbersWouldBeSeen) {
  Random dice(12);
  for (int waves = 1; waves <= format::kMaxSeriesWaves; ++waves) {
    auto numbers = random_numbers(dice, waves);
    const double q = 0.5 / waves;  // no sine or cosine of a multiple is 0 there
    const long double right = plain_sum(numbers, q);
    numbers[static_cast<std::size_t>(2 * waves - 2)] += 1e-9;
    EXPECT_GT(std::abs(static_cast<double>(static_cast<long double>(moved(numbers, q)) - right)),
              kBound * size_of(numbers))
        << waves;
  }
}

TEST(JointSeries, RepeatsWithEveryTurn) {
  Random dice(13);
  for (int i = 0; i < 1000; ++i) {
    const auto numbers = random_numbers(dice, 40);
    const double q = dice.uniform(-3.0, 3.0);
    const double turned = moved(numbers, q + 2.0 * std::numbers::pi);
    // The turn itself is rounded, and the fortieth wave sees that forty times.
    EXPECT_NEAR(moved(numbers, q), turned, 1e-13 * 40 * size_of(numbers));
  }
}

TEST(JointSeries, ItsSlopesAreTheWavesThemselves) {
  Random dice(14);
  std::array<double, 2 * format::kMaxSeriesWaves> slopes{};
  for (int i = 0; i < 1000; ++i) {
    const double q = random_angle(dice);
    JointSeries::slopes(portable::sin_cos(q), slopes);
    for (std::size_t k = 0; k < slopes.size() / 2; ++k) {
      const long double angle = static_cast<long double>(k + 1) * static_cast<long double>(q);
      EXPECT_NEAR(slopes[2 * k], static_cast<double>(std::sin(angle)), kBound);
      EXPECT_NEAR(slopes[2 * k + 1], static_cast<double>(std::cos(angle)), kBound);
    }
  }
}

TEST(JointSeries, HasNoNumbersIfItsConstantIsNoNumberOfWaves) {
  const std::array<std::uint8_t, 1> joints{0};
  const auto count = [&](double waves) {
    const std::array<double, 3> constants{waves, 1e-4, 1.0};
    return JointSeries::count({.arm_joints = 1, .joints = joints, .constants = constants});
  };
  EXPECT_EQ(count(40.0), 80);
  EXPECT_EQ(count(static_cast<double>(format::kMaxSeriesWaves)), 2 * format::kMaxSeriesWaves);
  for (const double wrong : {0.0, -1.0, 0.5, 40.5, 65.0, 1e300, std::nan("")})
    EXPECT_EQ(count(wrong), -1) << wrong;
}

}  // namespace
}  // namespace plumb
