// SPDX-License-Identifier: Apache-2.0
#include "solve/odd_pose.hpp"

#include <cmath>

#include "numbers/lu.hpp"
#include "solve/constants.hpp"
#include "solve/orthonormal.hpp"

namespace plumb::offline {
/// Let r be the residuals and H the hat matrix of all lines. Without pose i the others predict it
/// with an error of e = (I - H_ii)^-1 r_i, and their own residuals become r_j + H_ji e
/// [Cook & Weisberg 1982].
std::optional<std::size_t> odd_pose(const FitData& data, const Solution& solution) {
  const LineTable table = data.line_table();
  const Eigen::Index all = solution.residual.size();
  const Eigen::MatrixXd Q = orthonormal(solution.jacobian, all).U;
  std::optional<std::size_t> out;
  double farthest = kOutlierTimes;
  for (std::size_t i = 0; i < data.rows.size(); ++i) {
    const auto reading = static_cast<Eigen::Index>(i);
    const Eigen::Index at = table.begin(reading), lines = table.count(reading);
    const double left = static_cast<double>(all - lines - Q.cols());
    if (left < kFewestLines) continue;
    const Eigen::MatrixXd own = Q.middleRows(at, lines);
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(lines, lines) - own * own.transpose();
    const auto alone = solved_if_regular(rest, solution.residual.segment(at, lines));
    if (!alone) continue;  // the other poses do not predict this one
    const Eigen::VectorXd& e = *alone;
    Eigen::VectorXd others = solution.residual + Q * (own.transpose() * e);
    others.segment(at, lines).setZero();
    const double scatter = std::max(1.0, std::sqrt(others.squaredNorm() / left));
    const double times = e.norm() / (scatter * std::sqrt(static_cast<double>(lines)));
    if (times <= farthest) continue;
    farthest = times;
    out = i;
  }
  return out;
}

}  // namespace plumb::offline
