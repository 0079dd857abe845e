// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/latency_histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/random_numbers.hpp"

namespace plumb::drivers {
namespace {

constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();

/// The smallest of the sorted values that `share` of all do not exceed.
std::int64_t literal_percentile(const std::vector<std::int64_t>& sorted, double share) {
  const double n = static_cast<double>(sorted.size());
  const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(share * n)));
  return sorted[rank - 1];
}

TEST(LatencyHistogram, PercentilesAreThoseOfTheSortedDataWithinABin) {
  constexpr int kCases = 200;
  constexpr std::uint64_t kSeed = 11;
  std::printf("%ld cases, seed %d\n", tests::scaled(kCases), static_cast<int>(kSeed));
  tests::Random random(kSeed);
  for (long i = 0; i < tests::scaled(kCases); ++i) {
    LatencyHistogram histogram;
    std::vector<std::int64_t> data;
    for (int n = 1 + random.below(500); n > 0; --n)
      data.push_back(static_cast<std::int64_t>(std::exp(random.uniform(-1.0, 40.0))));
    for (const auto latency : data) histogram.add(latency);
    std::sort(data.begin(), data.end());
    for (const double share : {0.0, 0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0}) {
      const auto exact = literal_percentile(data, share);
      EXPECT_GE(histogram.percentile_ns(share), exact);
      EXPECT_LE(histogram.percentile_ns(share), exact + exact / 16);
    }
    EXPECT_EQ(histogram.count(), data.size());
    EXPECT_EQ(histogram.worst_ns(), data.back());
    EXPECT_EQ(histogram.percentile_ns(1.0), data.back());
  }
}

TEST(LatencyHistogram, BinsAreOneAfterAnotherAndHoldEveryLatency) {
  for (std::size_t i = 0; i + 1 < LatencyHistogram::kBins; ++i) {
    const auto first = LatencyHistogram::lower_ns(i), next = LatencyHistogram::lower_ns(i + 1);
    ASSERT_LT(first, next);
    LatencyHistogram histogram;
    histogram.add(first);
    histogram.add(next - 1);
    ASSERT_EQ(histogram.in_bin(i), 2U) << i;
  }
  LatencyHistogram histogram;
  histogram.add(kLargest);
  EXPECT_EQ(histogram.in_bin(LatencyHistogram::kBins - 1), 1U);
  EXPECT_EQ(histogram.percentile_ns(0.5), kLargest);
}

TEST(LatencyHistogram, CountsNegativeLatenciesAsNone) {
  LatencyHistogram histogram;
  histogram.add(-5);
  histogram.add(std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(histogram.in_bin(0), 2U);
  EXPECT_EQ(histogram.worst_ns(), 0);
}

TEST(LatencyHistogram, IsZeroBeforeTheFirst) {
  const LatencyHistogram histogram;
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.percentile_ns(0.5), 0);
  EXPECT_EQ(histogram.worst_ns(), 0);
}

TEST(LatencyHistogram, TakesAnyShare) {
  LatencyHistogram histogram;
  for (int i = 1; i <= 10; ++i) histogram.add(i);
  EXPECT_EQ(histogram.percentile_ns(-1.0), 1);
  EXPECT_EQ(histogram.percentile_ns(7.0), 10);
  EXPECT_EQ(histogram.percentile_ns(std::numeric_limits<double>::quiet_NaN()), 10);
}

}  // namespace
}  // namespace plumb::drivers
