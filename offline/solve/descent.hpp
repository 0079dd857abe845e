// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// `solve` for Jacobians that are too large to be kept (see is_many): Gauss-Newton steps from sums
/// over the rows, damped if they raise the cost. From a good start, one or two steps on all rows
/// are enough; a poor start is improved on a part of the rows first.
Solution solve_many(const FitData& data, const ArmState& start,
                    const std::vector<Parameter>& parameters, double tolerance);

/// R with R^T R = information.
Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& information);

}  // namespace plumb::offline
