// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// R of A = Q R by Householder reflections: upper triangular, min(rows, columns) of A high, as wide
/// as A. Its rows may have either sign. [Golub & Van Loan 2013, 5.2] Cost: 2 rows columns^2.
Eigen::MatrixXd householder_triangle(const Eigen::MatrixXd& A);

/// 1 / norm of each column, shape (columns,); of a column of zeros 1e300.
Eigen::VectorXd per_norm(const Eigen::MatrixXd& A);

/// R^-1 B, R^-T B and A R^-1, of a square R whose upper triangle is read.
Eigen::MatrixXd upper_solved(const Eigen::MatrixXd& R, const Eigen::MatrixXd& B);
Eigen::MatrixXd upper_transposed_solved(const Eigen::MatrixXd& R, const Eigen::MatrixXd& B);
Eigen::MatrixXd divided_by_upper(const Eigen::MatrixXd& A, const Eigen::MatrixXd& R);

}  // namespace plumb::offline
