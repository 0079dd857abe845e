// SPDX-License-Identifier: Apache-2.0
#include "draw/ticks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "draw/duration.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline::draw {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::vector<std::string> texts(const std::vector<Tick>& ticks) {
  std::vector<std::string> out;
  for (const Tick& tick : ticks) out.push_back(tick.text);
  return out;
}

TEST(RoundTicks, AreThoseThatAPersonWouldChoose) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(texts(round_ticks(0.0, 0.93, 6)), (Texts{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(texts(round_ticks(-175.0, 180.0, 6)), (Texts{"-200", "-100", "0", "100", "200"}));
  EXPECT_EQ(texts(round_ticks(0.0, 0.0041, 12)),
            (Texts{"0.0000", "0.0005", "0.0010", "0.0015", "0.0020", "0.0025", "0.0030", "0.0035",
                   "0.0040", "0.0045"}));
}

TEST(RoundTicks, CoverAnyRangeWithAtMostTwelveInStepsOfOneTwoOrFive) {
  tests::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double scale = std::pow(10.0, random.uniform(-8.0, 8.0));
    const double low = scale * random.uniform(-1.0, 1.0);
    const double high = low + scale * random.uniform(0.001, 2.0);
    const int most = 3 + i % 10;
    const auto ticks = round_ticks(low, high, most);
    ASSERT_GE(ticks.size(), 2U);
    ASSERT_LE(static_cast<int>(ticks.size()), most) << low << " " << high;
    const double step = ticks[1].value - ticks[0].value;
    ASSERT_LE(ticks.front().value, low + 1e-6 * step);
    ASSERT_GE(ticks.back().value, high - 1e-6 * step);
    ASSERT_GT(ticks[1].value, low) << "a tick too many at the low end";
    ASSERT_LT(ticks[ticks.size() - 2].value, high) << "a tick too many at the high end";
    const double lead = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
    const double off = std::min({std::abs(lead - 1.0), std::abs(lead - 2.0), std::abs(lead - 5.0)});
    ASSERT_LT(off, 1e-5) << step;
  }
}

TEST(RoundTicks, ARangeThatIsNoneBecomesOne) {
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{{0.0, 0.0},
                                                                        {3.0, 3.0},
                                                                        {-2.0, -2.0},
                                                                        {5.0, 1.0},
                                                                        {kNan, kNan},
                                                                        {kNan, 4.0},
                                                                        {4.0, kNan},
                                                                        {-kInf, kInf},
                                                                        {0.0, kInf},
                                                                        {0.0, 5e-324},
                                                                        {-1e308, 1e308}}) {
    const auto ticks = round_ticks(low, high, 8);
    ASSERT_GE(ticks.size(), 2U) << low << " " << high;
    ASSERT_LE(ticks.size(), 8U) << low << " " << high;
    for (const Tick& tick : ticks) EXPECT_TRUE(std::isfinite(tick.value));
    EXPECT_GT(ticks.back().value, ticks.front().value);
  }
}

TEST(RoundTicks, ZeroHasNoSign) {
  for (const Tick& tick : round_ticks(-0.3, 0.3, 7))
    EXPECT_NE(tick.text.substr(0, 2), tick.value == 0.0 ? "-0" : "--") << tick.text;
}

TEST(LogTicks, CoverTheRangeAndAreAtMostTwelve) {
  tests::Random random(2);
  for (int i = 0; i < 500; ++i) {
    const double low = std::pow(10.0, random.uniform(-9.0, 9.0));
    const double high = low * std::pow(10.0, random.uniform(0.0, 18.0));
    const auto ticks = log_ticks(low, high, 3 + i % 10);
    ASSERT_LE(static_cast<int>(ticks.size()), 3 + i % 10) << low << " " << high;
    ASSERT_LE(ticks.front().value, low * 1.000001);
    ASSERT_GE(ticks.back().value, high * 0.999999);
  }
  for (const double bad : {0.0, -1.0, kNan, kInf}) EXPECT_GE(log_ticks(bad, bad, 6).size(), 2U);
}

TEST(Digits, AreSignificantOnesWithoutAnExponent) {
  EXPECT_EQ(digits(0.04123, 2), "0.041");
  EXPECT_EQ(digits(0.0999, 2), "0.10");
  EXPECT_EQ(digits(412.4, 2), "410");
  EXPECT_EQ(digits(-0.5, 1), "-0.5");
  EXPECT_EQ(digits(0.0, 3), "0");
  EXPECT_EQ(digits(kNan, 3), "none");
}

TEST(Duration, ReadsInTheUnitThatFits) {
  EXPECT_EQ(duration(0.0), "0 ns");
  EXPECT_EQ(duration(999.4), "999 ns");
  EXPECT_EQ(duration(999.6), "1 us");
  EXPECT_EQ(duration(2412.0), "2.41 us");
  EXPECT_EQ(duration(1.5e6), "1.5 ms");
}

}  // namespace
}  // namespace plumb::offline::draw
