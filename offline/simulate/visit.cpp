// SPDX-License-Identifier: Apache-2.0
#include "simulate/visit.hpp"

#include <cmath>

namespace plumb::offline::sim {

std::vector<Visit> drive(const RowsN& q, const VectorXd& start, double seconds_per_pose) {
  std::vector<Visit> visits;
  visits.reserve(static_cast<std::size_t>(q.rows()));
  Visit now;
  now.q = now.before = start;
  now.direction = now.travel = VectorXd::Zero(start.size());
  now.zone_K = VectorXd::Zero(start.size() + 1);
  for (int row = 0; row < q.rows(); ++row) {
    now.time_s = row * seconds_per_pose;
    const VectorXd step = q.row(row).transpose() - now.q;
    if (!step.isZero(0.0)) now.before = now.q;
    for (int j = 0; j < start.size(); ++j) {
      if (step(j) == 0.0) continue;
      now.direction(j) = step(j) > 0.0 ? 1.0 : -1.0;
      now.travel(j) = std::abs(step(j));
    }
    now.q = q.row(row).transpose();
    visits.push_back(now);
  }
  return visits;
}

}  // namespace plumb::offline::sim
