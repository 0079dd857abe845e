// SPDX-License-Identifier: Apache-2.0
#include "bench/stopwatch.hpp"

#include <algorithm>
#include <vector>

namespace plumb::offline::bench {

double clock_cost_ns() {
  std::vector<double> nothing(4001);
  for (double& ns : nothing) {
    const double begin = now_ns();
    ns = now_ns() - begin;
  }
  const auto middle = nothing.begin() + static_cast<std::ptrdiff_t>(nothing.size() / 2);
  std::nth_element(nothing.begin(), middle, nothing.end());
  return *middle;
}

}  // namespace plumb::offline::bench
