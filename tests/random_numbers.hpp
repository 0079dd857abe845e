// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace plumb::tests {

/// SplitMix64 [Steele 2014]: the same numbers with every compiler.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1.0p-53);
  }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }

 private:
  std::uint64_t state_;
};

/// The number of random cases multiplied by the environment variable PLUMB_TEST_SCALE.
/// scripts/test-long sets it above 1, the tests on emulated processors set it below 1.
inline long scaled(long count) {
  const char* scale = std::getenv("PLUMB_TEST_SCALE");
  if (scale == nullptr) return count;
  return std::max(1L, static_cast<long>(static_cast<double>(count) * std::atof(scale)));
}

/// The first `count` of the cases, multiplied as above: at 100 all of them.
template <typename T>
std::vector<T> first_of(std::vector<T> cases, long count) {
  cases.resize(std::min(cases.size(), static_cast<std::size_t>(scaled(count))));
  return cases;
}

}  // namespace plumb::tests
