// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// The rotation R that makes tr(R^T M) largest: with M = sum of a_i b_i^T, the one that turns the b
/// best into the a. [Kabsch 1976]
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M);

/// The orthogonal matrix nearest to M, a mirror where M has a negative determinant, and the sum of
/// the singular values of M.
struct NearestOrthogonal {
  Eigen::Matrix3d Q;
  double sum = 0.0;
};
NearestOrthogonal nearest_orthogonal(const Eigen::Matrix3d& M);

/// The quaternion (w, x, y, z), w >= 0, that `sum` = sum of q_i q_i^T has most of: the mean of
/// rotations whose signs are not known. [Markley 2007]
Eigen::Vector4d mean_quaternion(const Eigen::Matrix4d& sum);

/// Eigenvalues of a symmetric matrix, ascending.
Eigen::Vector3d symmetric_eigenvalues(const Eigen::Matrix3d& S);

}  // namespace plumb::offline
