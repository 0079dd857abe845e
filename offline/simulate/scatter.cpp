// SPDX-License-Identifier: Apache-2.0
#include "simulate/scatter.hpp"

#include "simulate/random.hpp"

namespace plumb::offline::sim {

RowsN draw_scatter(const SimulationPlan& plan, const std::vector<Visit>& visits) {
  const auto& sigma = plan.imperfections.joint_scatter;
  if (sigma.empty() || visits.empty()) return {};
  Random random(plan.seed, "joint scatter");
  RowsN out(static_cast<Eigen::Index>(visits.size()), visits.front().q.size());
  for (Eigen::Index row = 0; row < out.rows(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    if (row > 0 && visits[at].q == visits[at - 1].q) {
      out.row(row) = out.row(row - 1);
      continue;
    }
    for (Eigen::Index j = 0; j < out.cols(); ++j) {
      const double own = sigma[sigma.size() == 1 ? 0 : static_cast<std::size_t>(j)];
      out(row, j) = own * random.normal();
    }
  }
  return out;
}

}  // namespace plumb::offline::sim
