// SPDX-License-Identifier: Apache-2.0
#include "simulate/poses.hpp"

#include <cmath>
#include <vector>

#include "simulate/random.hpp"

namespace plumb::offline::sim {
namespace {

using Eigen::VectorXd;

RowsN drawn(const SimulationPlan& plan, const VectorXd& q_min, const VectorXd& q_max) {
  Random random(plan.seed, "poses");
  RowsN q(plan.poses, q_min.size());
  for (Eigen::Index row = 0; row < q.rows(); ++row) {
    for (Eigen::Index j = 0; j < q.cols(); ++j) q(row, j) = random.uniform(q_min(j), q_max(j));
  }
  return q;
}

// Moves each joint to the nearest of `levels` equally spaced positions, which include the limits.
void snap(RowsN& q, int levels, const VectorXd& q_min, const VectorXd& q_max) {
  for (Eigen::Index j = 0; j < q.cols(); ++j) {
    const double step = (q_max(j) - q_min(j)) / (levels - 1);
    for (Eigen::Index row = 0; row < q.rows(); ++row) {
      q(row, j) = q_min(j) + step * std::round((q(row, j) - q_min(j)) / step);
    }
  }
}

// Orders the poses so that each is followed by the nearest remaining one, as an operator would do
// to save time.
RowsN nearest_first(const RowsN& q) {
  std::vector<bool> done(static_cast<std::size_t>(q.rows()), false);
  RowsN out(q.rows(), q.cols());
  Eigen::Index now = 0;
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    out.row(k) = q.row(now);
    done[static_cast<std::size_t>(now)] = true;
    double best = INFINITY;
    Eigen::Index next = now;
    for (Eigen::Index other = 0; other < q.rows(); ++other) {
      if (done[static_cast<std::size_t>(other)]) continue;
      const double away = (q.row(other) - out.row(k)).squaredNorm();
      if (away < best) best = away, next = other;
    }
    now = next;
  }
  return out;
}

}  // namespace

RowsN distinct_poses(const SimulationPlan& plan, const VectorXd& q_min, const VectorXd& q_max) {
  if (plan.q.rows() > 0) return plan.q;
  const VectorXd middle = 0.5 * (q_min + q_max);
  const VectorXd low = middle + plan.choice.range * (q_min - middle);
  const VectorXd high = middle + plan.choice.range * (q_max - middle);
  RowsN q = plan.choice.range == 1.0 ? drawn(plan, q_min, q_max) : drawn(plan, low, high);
  if (plan.choice.grid_levels > 1) snap(q, plan.choice.grid_levels, low, high);
  if (plan.choice.order == PoseChoice::Order::kNearest) return nearest_first(q);
  return q;
}

}  // namespace plumb::offline::sim
