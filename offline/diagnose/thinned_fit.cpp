// SPDX-License-Identifier: Apache-2.0
#include "diagnose/thinned_fit.hpp"

namespace plumb::offline {

WhitenedFit thinned(const WhitenedFit& whitened, Eigen::Index most) {
  std::vector<Eigen::Index> pose, line;
  WhitenedFit out;
  for (const auto& fold : whitened.folds) {
    const auto begin = static_cast<Eigen::Index>(pose.size());
    for (Eigen::Index i = fold.begin; i < fold.end; ++i)
      if (i * most / whitened.fit_poses() != (i + 1) * most / whitened.fit_poses())
        pose.push_back(i);
    out.folds.push_back({begin, static_cast<Eigen::Index>(pose.size())});
  }
  line = whitened.table.lines_of(pose);
  out.cell = whitened.cell;
  out.measured = whitened.measured;
  for (const auto i : pose) {
    const auto at = static_cast<std::size_t>(i);
    out.row.push_back(whitened.row[at]);
    out.frames.push_back(whitened.frames[at]);
    out.X_MB.push_back(whitened.X_MB[at]);
    out.reading.push_back(whitened.reading[at]);
    out.loads.push_back(whitened.loads[at]);
    out.context.push_back(whitened.context[at]);
    out.arm_B.push_back(whitened.arm_B[at]);
    if (!whitened.root.empty()) out.root.push_back(whitened.root[at]);
  }
  for (const auto l : line) out.sigma.push_back(whitened.sigma[static_cast<std::size_t>(l)]);
  out.held = {static_cast<Eigen::Index>(pose.size()), static_cast<Eigen::Index>(pose.size())};
  out.table = whitened.table.picked(pose);
  out.fit_lines = static_cast<Eigen::Index>(line.size());
  out.noise = whitened.noise;
  out.sigma_m = whitened.sigma_m;
  out.half_information = whitened.half_information;
  out.correction = whitened.correction;
  out.scatter_nats = whitened.scatter_nats;
  for (const auto& carrier : whitened.joint) out.joint.push_back(carrier(line));
  out.base = whitened.base(line, Eigen::all);
  out.tool = whitened.tool(line, Eigen::all);
  out.chain = whitened.chain;
  out.sensors = whitened.sensors;
  out.y = whitened.y(line);
  out.U = orthonormal(whitened.U(line, Eigen::all), out.fit_lines).U;
  out.rank = out.U.cols();
  clear_residual(out);
  fold_joints(out);
  return out;
}

}  // namespace plumb::offline
