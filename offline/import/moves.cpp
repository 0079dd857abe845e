// SPDX-License-Identifier: Apache-2.0
#include "import/moves.hpp"

#include <cmath>

namespace plumb::offline {

Arrivals arrivals_from_order(const std::vector<double>& q, double still) {
  Arrivals out;
  int direction = 0;
  double travel = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double move = i > 0 ? q[i] - q[i - 1] : 0.0;
    if (std::abs(move) > still) {
      direction = move > 0 ? 1 : -1;
      travel = std::abs(move);
    }
    out.direction.push_back(direction);
    out.travel.push_back(travel);
  }
  return out;
}

}  // namespace plumb::offline
