// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"
#include "solve/outlier.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// Distance of every pose from what the *other* poses predict, in its own standard deviations:
/// sqrt(e^T (I - H)^-1 e) with e the whitened residuals of the pose and H its block of the hat
/// matrix, so a pose cannot hide by pulling the fit. Shape (poses,). Cost: poses * parameters^2.
/// [Cook & Weisberg 1982]
Eigen::VectorXd deletion_distances(const FitData& data, const Solution& solution);

/// The same of a solution of these parameters, whose Jacobian may be only its triangle (is_many).
Eigen::VectorXd deletion_distances(const FitData& data, const Solution& solution,
                                   const std::vector<Parameter>& parameters);

/// Usual size of such distances: their median as a multiple of what noise alone gives, at least 1.
double usual_scatter(const Eigen::VectorXd& distances, int per_pose);

/// Least squares without the poses that the others contradict: farther away than 6 times the usual
/// scatter. The farthest go first, the fit is repeated, and who then agrees comes back. Takes them
/// out of `data.rows` and returns them, farthest first. More than one pose in eight would be no
/// outliers but a wrong model: then none is taken out. A set-up never loses more than one pose, or
/// a third of them.
std::vector<Outlier> solve_without_outliers(FitData& data, const std::vector<Parameter>& parameters,
                                            Solution& solution);

}  // namespace plumb::offline
