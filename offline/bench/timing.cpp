// SPDX-License-Identifier: Apache-2.0
#include "bench/timing.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::offline::bench {

double Timing::at_share(double share) const {
  const double rank = std::ceil(share * static_cast<double>(ns.size()));
  return ns.at(static_cast<std::size_t>(std::max(0.0, rank - 1.0)));
}

}  // namespace plumb::offline::bench
