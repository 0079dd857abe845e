// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// No tracker is better [m]: what is below counts as this, as in data without noise.
inline constexpr double kSmallestSigma_m = 0.1e-6;

/// 1 sigma of every measured coordinate, shape (n, 3) [m]: from the file's columns, else from the
/// cell, else 10 um; never below 0.1 um.
Rows3 stated_sigma(const Cell& cell, const Measurements& measured);

/// What the model leaves beyond the stated noise: tau with sum r^2 / (sigma^2 + tau^2) = dof, 0 if
/// the noise alone explains the residuals. A model that lacks an effect must not let a reading with
/// a small sigma outvote the others. residual, sigma: shape (n, 3) [m]; unused axes have residual 0
/// and are left out by `axis_used`.
double excess_sigma(const Rows3& residual, const Rows3& sigma, const std::array<bool, 3>& axis_used,
                    int parameters);

}  // namespace plumb::offline
