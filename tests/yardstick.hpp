// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <vector>

/// Time of the processor, never that of a clock on the wall: other programs share the cores.
namespace plumb::tests {

inline double seconds_of(const rusage& used) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// What this process has used so far, all threads together, or its children that have ended. [s]
inline double processor_s(bool of_children = false) {
  rusage used{};
  getrusage(of_children ? RUSAGE_CHILDREN : RUSAGE_SELF, &used);
  return seconds_of(used);
}

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

/// How many times slower a core of this machine is at present than one of the reference machine,
/// which does that work in 75 ms; at least 1. Marks of processor time are multiplied by it.
inline double times_slower() {
  constexpr double kUsual_s = 0.075;
  const double begin = processor_s();
  sort_numbers();
  return std::max(1.0, (processor_s() - begin) / kUsual_s);
}

}  // namespace plumb::tests
