// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plumb::drivers {

/// A histogram of latencies from 1 ns to centuries, of a fixed size of 8 kB.
///
/// There are 16 bins per power of two: a bin is at most 1/16 of its value wide, and 1 ns wide below
/// 16 ns. The largest latency is kept exactly. Negative latencies count as 0.
///
/// One thread. No allocation; add() costs the same for every value.
class LatencyHistogram {
 public:
  static constexpr int kBinsPerOctave = 16;
  static constexpr std::size_t kBins = 60 * kBinsPerOctave;

  void add(std::int64_t latency_ns) noexcept;

  std::uint64_t count() const noexcept { return count_; }

  /// The largest latency ever added [ns]; 0 before the first.
  std::int64_t worst_ns() const noexcept { return worst_ns_; }

  /// The smallest latency [ns] that a fraction `share` (0 .. 1) of all latencies did not exceed,
  /// rounded up to the edge of its bin and never above the worst. 0 before the first latency; NaN
  /// counts as a share of 1. Cost: one pass over the bins, too slow for the cycle.
  std::int64_t percentile_ns(double share) const noexcept;

  /// Bin i counts the latencies from lower_ns(i) to lower_ns(i + 1) - 1.
  std::uint64_t in_bin(std::size_t i) const noexcept { return bins_[i]; }
  static std::int64_t lower_ns(std::size_t i) noexcept;

 private:
  static std::int64_t upper_ns(std::size_t i) noexcept;

  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t worst_ns_ = 0;
};

}  // namespace plumb::drivers
