// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// Eigenvalues of a symmetric matrix, ascending, and its eigenvectors as columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& S);

/// The largest x with det(A - x B) = 0; A symmetric, B symmetric and positive definite.
double largest_generalised_eigenvalue(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Singular values, descending, by Jacobi rotations: small ones keep their relative accuracy.
Eigen::VectorXd jacobi_singular_values(const Eigen::MatrixXd& A);

/// The same with the right singular vectors as columns, (columns, columns) for a square or tall A.
struct RightSingular {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
RightSingular right_singular(const Eigen::MatrixXd& A);

}  // namespace plumb::offline
