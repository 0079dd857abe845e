// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tree/growth.hpp"

/// Trees as the study and textbooks have them; for comparison only, never compiled into a model.
namespace plumb::offline::study {

/// As published: what a leaf says is not held to what it saw.
format::Tree unheld(format::Tree tree);

/// LOLIMOT [Nelles 2000]: halves the cell whose samples it misses most, along the input that helps
/// most; normalised Gaussian validity of sigma = width / 3, each leaf fitted to the samples
/// weighted by its validity. Predictions at u_test, shape (m,).
Eigen::VectorXd lolimot(const Samples& u, const Eigen::VectorXd& y, int leaves,
                        const Samples& u_test);

/// M5's smoothing [Quinlan 1992]: a leaf's value is mixed with those of the cells above it,
/// p' = (n p + k q) / (n + k) with k = 15, n the samples of the lower cell. Shape (m,).
Eigen::VectorXd m5_smoothed(const GrownTree& tree, const Splits& stand, const Samples& u_test);

}  // namespace plumb::offline::study
