// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// A^T B of matrices with many rows. A diagnosis spends most of its time on these, and Eigen
/// computes them one number at a time (PlumbOptions.cmake). Here four are computed at once where
/// the processor has AVX2; every processor gives the same bits. Cost: rows * columns of A * columns
/// of B. Any thread.
Eigen::MatrixXd transposed_product(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                   const Eigen::Ref<const Eigen::MatrixXd>& B);

/// The same where the product is known to be symmetric, as if B is A with its rows weighed: half
/// the cost. The result is symmetric to the last bit.
Eigen::MatrixXd symmetric_product(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                  const Eigen::Ref<const Eigen::MatrixXd>& B);

/// A^T A.
inline Eigen::MatrixXd gram_matrix(const Eigen::Ref<const Eigen::MatrixXd>& A) {
  return symmetric_product(A, A);
}

}  // namespace plumb::offline
