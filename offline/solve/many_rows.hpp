// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// Beyond so many rows some of them tell a start, and the noise, as well as all do.
inline constexpr int kManyRows = 20000;

/// A Jacobian of more than 1.5 million numbers is never held as a whole: `solve` then works with
/// sums over the rows, and returns as `jacobian` a triangle R with R^T R = J^T J.
bool is_many(const FitData& data, const std::vector<Parameter>& parameters);

/// Lines of a Jacobian as the solver keeps them: line by line.
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace plumb::offline
