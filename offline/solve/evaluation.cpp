// SPDX-License-Identifier: Apache-2.0
#include "solve/evaluation.hpp"

#include "solve/fit_lines.hpp"
#include "solve/many_rows.hpp"
#include "solve/solution_checks.hpp"

namespace plumb::offline {

Solution evaluate(const FitData& data, const ArmState& start,
                  const std::vector<Parameter>& parameters) {
  const FitLines lines(data, start, parameters);
  const auto count = static_cast<Eigen::Index>(parameters.size());
  Solution out;
  out.state = start;
  out.residual.resize(lines.count());
  RowMajorMatrix jacobian(lines.count(), count);
  lines.evaluate(Eigen::VectorXd::Zero(count), out.residual.data(),
                 count > 0 ? jacobian.data() : nullptr);
  if (const auto& [row, effect] = lines.undefined(); row >= 0)
    refuse_undefined(data, start.arm.effects[static_cast<std::size_t>(effect)], row);
  out.jacobian = -jacobian;
  out.cost = 0.5 * out.residual.squaredNorm();
  out.converged = true;
  return out;
}

}  // namespace plumb::offline
