// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// No tracker is better than this [m]. A smaller sigma, as of data without noise, is raised to it.
inline constexpr double kSmallestSigma_m = 0.1e-6;

/// 1 sigma of a coordinate if neither the files nor the cell state one [m]: that of a laser tracker
/// at some metres.
inline constexpr double kUnstatedSigma_m = 10e-6;

/// The same of a touched point [m]: the play of a ball in a socket that was not made by a printer.
inline constexpr double kUnstatedTouch_m = 50e-6;

/// 1 sigma of every measured coordinate, shape (n, 3) [m]: from the file's columns, else from the
/// cell, else 10 um, of a touched point 50 um; never below 0.1 um.
Rows3 stated_sigma(const Cell& cell, const Measurements& measured);

/// 1 sigma of a coordinate for a plan of poses [m]: from repeats if there are enough, else as the
/// cell states it, else 10 um. The error of the model does not count.
double reading_sigma(const Cell& cell, const Measurements& used);

/// The scatter tau of the residuals beyond the stated noise, by sum r^2 / (sigma^2 + tau^2) = dof;
/// 0 if the noise alone explains the residuals. Adding tau^2 to every sigma^2 keeps readings of a
/// small sigma from outweighing all others while the model lacks an effect. residual, sigma: shape
/// (n, 3) [m]; residuals of what a row of `measured` does not read are 0.
double excess_sigma(const Measurements& measured, const Rows3& residual, const Rows3& sigma,
                    int parameters);

}  // namespace plumb::offline
