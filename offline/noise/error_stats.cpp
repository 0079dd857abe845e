// SPDX-License-Identifier: Apache-2.0
#include "noise/error_stats.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::offline {

ErrorStats summarise(std::vector<double> errors_m) {
  ErrorStats out;
  if (errors_m.empty()) return out;
  std::sort(errors_m.begin(), errors_m.end());
  const double n = static_cast<double>(errors_m.size());
  double sum = 0.0, squares = 0.0;
  for (double e : errors_m) {
    sum += e;
    squares += e * e;
  }
  out.n = static_cast<int>(errors_m.size());
  out.mean = sum / n;
  out.rms = std::sqrt(squares / n);
  out.p95 = errors_m[static_cast<std::size_t>(std::ceil(0.95 * n)) - 1];
  out.max = errors_m.back();
  return out;
}

}  // namespace plumb::offline
