// SPDX-License-Identifier: Apache-2.0
#include "check/observability.hpp"

#include <cmath>

namespace plumb::offline {

Observability observability(const Eigen::VectorXd& s, int poses) {
  const Eigen::Index m = s.size();
  if (m == 0 || !(s(m - 1) > 0.0) || poses < 1) return {};
  const double first = s(0), last = s(m - 1);
  return {.O1 = std::exp(s.array().log().mean()) / std::sqrt(static_cast<double>(poses)),
          .O2 = last / first,
          .O3 = last,
          .O4 = last * last / first,
          .O5 = 1.0 / s.array().inverse().sum()};
}

}  // namespace plumb::offline
