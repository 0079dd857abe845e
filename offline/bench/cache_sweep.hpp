// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace plumb::offline::bench {

/// Drives what a cycle left in the caches out of them, as the rest of a controller does between two
/// cycles.
class CacheSweep {
 public:
  static constexpr std::size_t kBytes = 8 << 20;  // beyond the second level of any present CPU

  CacheSweep() : lines_(kBytes / kLine) {}

  /// Writes every line once.
  void sweep() noexcept;

 private:
  static constexpr std::size_t kLine = 64;
  struct alignas(kLine) Line {
    unsigned touched = 0;
  };
  std::vector<Line> lines_;
};

}  // namespace plumb::offline::bench
