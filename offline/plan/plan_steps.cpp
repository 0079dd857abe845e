// SPDX-License-Identifier: Apache-2.0
#include "plan/plan_steps.hpp"

#include <algorithm>
#include <cmath>

#include "plan/driving_order.hpp"

namespace plumb::offline {

std::vector<Eigen::MatrixXd> blocks(const Eigen::MatrixXd& lines, int rows_each) {
  std::vector<Eigen::MatrixXd> out;
  for (Eigen::Index first = 0; first + rows_each <= lines.rows(); first += rows_each)
    out.emplace_back(lines.middleRows(first, rows_each));
  return out;
}

PredictionSigma prediction_sigma(const DesignSpace& space, const Measurements& check,
                                 const Eigen::MatrixXd& covariance) {
  DesignSpace bare = space;
  bare.sigma_m = 1.0;
  bare.sigma_rad = 0.0;
  Measurements points = check;
  points.quat_M.resize(0, 4);
  PredictionSigma out;
  const auto each = blocks(bare.lines(points), bare.per_pose());
  for (const auto& A : each) {
    const double sigma = std::sqrt((A * covariance * A.transpose()).trace());
    out.mean += sigma / static_cast<double>(each.size());
    out.worst = std::max(out.worst, sigma);
  }
  return out;
}

std::vector<int> driven(const Cell& cell, const PlanStart& start, const RowsN& q, double& drive) {
  Eigen::VectorXd range(cell.joints()), from(cell.joints());
  for (int j = 0; j < cell.joints(); ++j) {
    const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
    range(j) = std::max(1e-6, row.q_max - row.q_min);
    from(j) = 0.5 * (row.q_min + row.q_max);
  }
  if (start.used.size() > 0) from = start.used.q.row(start.used.size() - 1).transpose();
  const auto order = driving_order(q, range, from);
  drive += driving_length(q, order, range, from);
  return order;
}

}  // namespace plumb::offline
