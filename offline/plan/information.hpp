// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// What measurements tell about parameters: M = prior + sum A_i^T A_i of whitened derivatives, kept
/// as its inverse, the covariance.
class Information {
 public:
  /// Nothing measured; prior: information of each parameter, > 0.
  explicit Information(const Eigen::VectorXd& prior);

  /// Adds the rows of A, shape (rows, parameters). Cost: parameters^3 for many rows, rows *
  /// parameters^2 for few.
  void add(const Eigen::MatrixXd& A);

  /// Takes rows away that were added.
  void remove(const Eigen::MatrixXd& A);

  /// By how much ln det M would rise with these rows: ln det(I + A M^-1 A^T).
  double gain(const Eigen::MatrixXd& A) const;

  const Eigen::MatrixXd& covariance() const { return covariance_; }
  double ln_det() const { return ln_det_; }

 private:
  Eigen::MatrixXd covariance_;
  double ln_det_ = 0.0;
};

}  // namespace plumb::offline
