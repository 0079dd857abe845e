// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "figures/run_results.hpp"

/// Figures of the data and of what they determine. Each returns one SVG file, `width` px wide (320
/// to 4000), whatever the data.
namespace plumb::offline::figures {

/// Mean error by joint position and by region of the workspace, with the number of poses behind it:
/// one row for each, cut into equal steps. Cost: profiles * poses log poses.
std::string regions_figure(const RunResults& results, double width);

/// Which part of its range each joint used, with the held-out poses and the limits of the cell.
std::string coverage_figure(const RunResults& results, double width);

/// Correlation of the fitted numbers, ordered so that those that move together stand together.
/// Cost: numbers^2 log numbers.
std::string correlation_figure(const RunResults& results, double width);

}  // namespace plumb::offline::figures
