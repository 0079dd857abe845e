// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/latency_histogram.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace plumb::drivers {
namespace {

constexpr int kShift = std::countr_zero(unsigned{LatencyHistogram::kBinsPerOctave});

/// The bin of a value. Values below 2 * kBinsPerOctave have a bin each; above, the bin is given by
/// the leading bit and the four bits after it.
std::size_t bin_of(std::uint64_t value) noexcept {
  const int octave = std::max(0, static_cast<int>(std::bit_width(value)) - 1 - kShift);
  return static_cast<std::size_t>(octave) * LatencyHistogram::kBinsPerOctave +
         static_cast<std::size_t>(value >> octave);
}

}  // namespace

void LatencyHistogram::add(std::int64_t latency_ns) noexcept {
  const std::int64_t latency = std::max<std::int64_t>(0, latency_ns);
  ++bins_[bin_of(static_cast<std::uint64_t>(latency))];
  ++count_;
  worst_ns_ = std::max(worst_ns_, latency);
}

std::int64_t LatencyHistogram::lower_ns(std::size_t i) noexcept {
  if (i < 2 * kBinsPerOctave) return static_cast<std::int64_t>(i);
  const std::size_t octave = i / kBinsPerOctave - 1;
  return static_cast<std::int64_t>(i % kBinsPerOctave + kBinsPerOctave) << octave;
}

std::int64_t LatencyHistogram::upper_ns(std::size_t i) noexcept {
  return i + 1 < kBins ? lower_ns(i + 1) - 1 : std::numeric_limits<std::int64_t>::max();
}

std::int64_t LatencyHistogram::percentile_ns(double share) const noexcept {
  const double wanted = (share >= 0.0  ? std::min(share, 1.0)
                         : share < 0.0 ? 0.0
                                       : 1.0) *
                        static_cast<double>(count_);
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < kBins; ++i) {
    seen += bins_[i];
    if (bins_[i] > 0 && static_cast<double>(seen) >= wanted)
      return std::min(upper_ns(i), worst_ns_);
  }
  return worst_ns_;
}

}  // namespace plumb::drivers
