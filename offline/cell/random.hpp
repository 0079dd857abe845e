// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumb::offline {

/// SplitMix64 [Steele 2014]: the same numbers with every compiler and library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

  /// Uniform in 0 … n - 1.
  int below(int n) { return static_cast<int>(unit() * n); }

 private:
  std::uint64_t state_;
};

}  // namespace plumb::offline
