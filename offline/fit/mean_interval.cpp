// SPDX-License-Identifier: Apache-2.0
#include "fit/mean_interval.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "fit/constants.hpp"
#include "numbers/tails.hpp"

namespace plumb::offline {
// se^2 = G / (G - 1) sum_g (sum_i (e_gi - mean))^2 / n^2.
MeanInterval mean_interval(const std::vector<double>& errors_m, const std::vector<int>& pose) {
  const auto n = static_cast<double>(errors_m.size());
  const double mean = std::accumulate(errors_m.begin(), errors_m.end(), 0.0) / std::max(1.0, n);
  std::map<int, double> sums;
  for (std::size_t i = 0; i < errors_m.size(); ++i) sums[pose[i]] += errors_m[i] - mean;
  if (sums.size() < kFewestForInterval) return {};
  const auto poses = static_cast<double>(sums.size());
  double squares = 0.0;
  for (const auto& [group, sum] : sums) squares += sum * sum;
  const double se = std::sqrt(poses / (poses - 1.0) * squares) / n;
  const double half = student_quantile(kTwoSided95, poses - 1.0) * se;
  return {std::max(0.0, mean - half), mean + half, se};
}

MeanInterval held_out_interval(const Measurements& measured, const Fit& fit) {
  if (fit.held.n == 0 || fit.predicted_M.rows() != measured.size()) return {};
  const Rows3 error = residuals(measured, fit.predicted_M);
  std::vector<double> norms;
  std::vector<int> pose;
  const std::vector<int> group = held_together(measured);
  for (const int row : held_rows(fit.split)) {
    norms.push_back(error.row(row).norm());
    pose.push_back(group[static_cast<std::size_t>(row)]);
  }
  return mean_interval(norms, pose);
}

}  // namespace plumb::offline
