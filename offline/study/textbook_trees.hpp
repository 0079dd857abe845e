// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tree/growth.hpp"

/// Trees as in the study and in textbooks. They are used for comparison only and are never compiled
/// into a model.
namespace plumb::offline::study {

/// The tree without clamping the leaves to the range of their samples, as published.
format::Tree unheld(format::Tree tree);

/// LOLIMOT [Nelles 2000]: repeatedly halves the cell with the largest error, along the input that
/// lowers it most; normalised Gaussian validity of sigma = width / 3, each leaf fitted to the
/// samples weighted by its validity. Predictions at u_test, shape (m,).
Eigen::VectorXd lolimot(const Samples& u, const Eigen::VectorXd& y, int leaves,
                        const Samples& u_test);

/// M5's smoothing [Quinlan 1992]: a leaf's value is mixed with those of the cells above it,
/// p' = (n p + k q) / (n + k) with k = 15, n the samples of the lower cell. Shape (m,).
Eigen::VectorXd m5_smoothed(const GrownTree& tree, const Splits& stand, const Samples& u_test);

}  // namespace plumb::offline::study
