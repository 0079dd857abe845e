// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "arm/arm_state.hpp"
#include "solve/many_rows.hpp"
#include "solve/pose_lines.hpp"

namespace plumb::offline {

/// Sums over all rows at one state. A Gauss-Newton step needs no more, and the Jacobian is not
/// kept.
struct RowSums {
  Eigen::MatrixXd information;  // J^T J
  Eigen::VectorXd gradient;     // J^T residual
  Eigen::VectorXd residual;
  double cost = 0.0;
  PoseLines::Undefined undefined;

  bool finite() const { return undefined.row < 0 && std::isfinite(cost); }
  void add(const RowSums& part) {
    information += part.information;
    gradient += part.gradient;
    if (part.undefined.row >= 0 && undefined.row < 0) undefined = part.undefined;
  }
  void add(const Eigen::Ref<const RowMajorMatrix>& J, const Eigen::Ref<const Eigen::VectorXd>& r) {
    if (r.size() == 0) return;
    information.selfadjointView<Eigen::Lower>().rankUpdate(J.transpose());
    gradient.noalias() += J.transpose() * r;
  }
};

/// Cost: an evaluation of all rows, and lines * parameters^2. The result does not depend on the
/// number of threads.
RowSums sums_at(const FitData& data, const ArmState& state,
                const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
