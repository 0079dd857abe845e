// SPDX-License-Identifier: Apache-2.0
#include "solve/jacobian_visit.hpp"

#include <algorithm>

#include "arm/geometry_derivative.hpp"
#include "numbers/jobs.hpp"
#include "solve/pose_lines.hpp"
#include "solve/solution_checks.hpp"

namespace plumb::offline {

void visit_jacobian(const FitData& data, const ArmState& state,
                    const std::vector<Parameter>& parameters,
                    const std::function<void(int, const RowMajorMatrix&)>& visit) {
  const PoseLines poses(data, parameters);
  const auto count = static_cast<Eigen::Index>(parameters.size());
  const GeometryDerivative geometry(state, parameters, Eigen::VectorXd::Zero(count));
  const LineTable table = data.line_table();
  const int rows = static_cast<int>(data.rows.size());
  const auto visit_block = [&](int block) {
    const int first = block * kRowsOfOneThread, last = std::min(rows, first + kRowsOfOneThread);
    Eigen::VectorXd residual(table.count(first, last));
    RowMajorMatrix J(residual.size(), count);
    const auto [row, effect] = poses.evaluate(geometry, first, last, residual.data(), J.data());
    if (row >= 0) refuse_undefined(data, state.arm.effects[static_cast<std::size_t>(effect)], row);
    visit(first, J);
  };
  run_jobs((rows + kRowsOfOneThread - 1) / kRowsOfOneThread, visit_block);
}

}  // namespace plumb::offline
