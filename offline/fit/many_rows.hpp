// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "fit/solver.hpp"

namespace plumb::offline {

/// Beyond so many rows some of them tell a start, and the noise, as well as all do.
inline constexpr int kManyRows = 20000;

/// A Jacobian of more than 1.5 million numbers is never held as a whole: `solve` then works with
/// sums over the rows, and returns as `jacobian` a triangle R with R^T R = J^T J.
bool is_many(const FitData& data, const std::vector<Parameter>& parameters);

/// The Jacobian at `state`, some rows at a time: visit(place of the first row in `data.rows`,
/// whitened lines of these rows, shape (rows * per_pose, parameters)). Calls come from several
/// threads.
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
void visit_jacobian(const FitData& data, const ArmState& state,
                    const std::vector<Parameter>& parameters,
                    const std::function<void(int, const RowMajorMatrix&)>& visit);

/// As deletion_distances(data, solution), of a solution of these parameters.
Eigen::VectorXd deletion_distances(const FitData& data, const Solution& solution,
                                   const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
