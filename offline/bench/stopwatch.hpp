// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace plumb::offline::bench {

/// std::chrono::steady_clock [ns].
inline double now_ns() noexcept {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<double>(std::chrono::nanoseconds(now).count());
}

/// The time between two readings with nothing between them [ns]: the median of thousands. It is to
/// be subtracted from every interval.
double clock_cost_ns();

}  // namespace plumb::offline::bench
