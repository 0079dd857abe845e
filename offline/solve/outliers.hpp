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

/// The same of a solution of these parameters that may hold only the triangle of its Jacobian (see
/// is_many).
Eigen::VectorXd deletion_distances(const FitData& data, const Solution& solution,
                                   const std::vector<Parameter>& parameters);

/// Usual size of such distances of readings of so many lines: their median over the median that
/// noise of the stated sigma gives, but at least 1.
double usual_scatter(const Eigen::VectorXd& distances, Eigen::Index lines);

/// Distances of readings as if each of them had so many lines: noise of the stated sigma then gives
/// them all the same median.
Eigen::VectorXd comparable(Eigen::VectorXd distances, const LineTable& table, Eigen::Index lines);

/// Least squares without the poses that the others contradict: farther away than 6 times the usual
/// scatter. The farthest ones are taken out first and the fit is repeated until none is left; poses
/// that the final fit predicts well are then taken back once. Removes the outliers from `data.rows`
/// and returns them, farthest first. If more than one pose in eight would go, the model is wrong
/// rather than the poses, and none is taken out. A set-up never loses more than one pose, or a
/// third of its poses.
std::vector<Outlier> solve_without_outliers(FitData& data, const std::vector<Parameter>& parameters,
                                            Solution& solution);

}  // namespace plumb::offline
