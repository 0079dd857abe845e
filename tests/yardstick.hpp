// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

namespace plumb::tests {

/// Sorts 200,000 numbers five times. This is the work by which the speed of the machine is judged.
inline void sort_numbers() {
  for (int round = 0; round < 5; ++round) {
    std::vector<double> numbers(200000);
    std::uint64_t state = 1;
    for (double& x : numbers) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      x = static_cast<double>(state >> 11);
    }
    std::sort(numbers.begin(), numbers.end());
  }
}

/// How many times slower this machine is at present than an idle reference machine, at least 1.
/// Every core gets the same work, which takes 75 ms on the reference machine. Limits on wall time
/// are multiplied by this factor, because other tests share the cores.
inline double times_slower() {
  constexpr double kUsual_s = 0.075;
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::thread> cores;
  for (unsigned k = 0; k < std::max(1U, std::thread::hardware_concurrency()); ++k)
    cores.emplace_back(sort_numbers);
  for (auto& core : cores) core.join();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  return std::max(1.0, took.count() / kUsual_s);
}

}  // namespace plumb::tests
