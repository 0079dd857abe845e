// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "figures/run_results.hpp"

/// How far the model misses before and after calibration. Each returns one SVG file, `width` px
/// wide (320 to 4000), whatever the data: no poses, one, none held out. Cost: poses log poses.
namespace plumb::offline::figures {

/// Counts of errors on one locked axis, before above after, with tolerance and noise floor.
std::string error_hist(const RunResults& results, double width);

/// Share of the poses that miss by no more than an error, before and after.
std::string error_ecdf(const RunResults& results, double width);

/// Every pose, sorted by its error, with the same pose before; the worst ones named.
std::string error_by_pose(const RunResults& results, double width);

/// Views from above, from the side and from the front: the errors as arrows at the measured points,
/// all enlarged by one stated factor, and the arm in one pose.
std::string error_map(const RunResults& results, double width);

/// The errors of measured orientations over each joint, if the run fitted orientations.
std::string orientations_figure(const RunResults& results, double width);

}  // namespace plumb::offline::figures
