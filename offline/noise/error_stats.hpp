// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace plumb::offline {

/// Summary of 3-D position errors [m]; all zero if n == 0. p95 is the smallest error that at least
/// 95 % of them do not exceed, which is what the tolerance of a cell is held against.
struct ErrorStats {
  int n = 0;
  double mean = 0.0;
  double rms = 0.0;
  double p95 = 0.0;
  double max = 0.0;
};

ErrorStats summarise(std::vector<double> errors_m);

/// The same of as many errors, all larger by this factor.
inline ErrorStats scaled(const ErrorStats& stats, double times) {
  return {stats.n, times * stats.mean, times * stats.rms, times * stats.p95, times * stats.max};
}

}  // namespace plumb::offline
