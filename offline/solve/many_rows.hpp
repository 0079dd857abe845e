// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// A start of the fit and the scatter about it are found from at most so many rows: more would not
/// make them better. Bounds the time only.
inline constexpr int kManyRows = 20000;

/// Whether the Jacobian has more than 1.5 million numbers. It is then never held as a whole:
/// `solve` works with sums over the rows, and returns as `jacobian` a triangle R with
/// R^T R = J^T J.
bool is_many(const FitData& data, const std::vector<Parameter>& parameters);

/// A Jacobian stored row by row.
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace plumb::offline
