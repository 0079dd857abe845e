// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

namespace plumb::offline {

/// Of a square matrix, by LU decomposition. [Golub & Van Loan 2013, 3.4] Cost: 2/3 n^3.
double determinant(const Eigen::MatrixXd& A);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);

/// A^-1 b; nothing if A is singular up to rounding.
std::optional<Eigen::VectorXd> solved_if_regular(const Eigen::MatrixXd& A,
                                                 const Eigen::VectorXd& b);

}  // namespace plumb::offline
