// SPDX-License-Identifier: Apache-2.0
#include "plan/information.hpp"

#include "numbers/cholesky.hpp"

namespace plumb::offline {
namespace {

/// I + sign A M^-1 A^T.
Eigen::MatrixXd grown(const Eigen::MatrixXd& A, const Eigen::MatrixXd& covariance, double sign) {
  Eigen::MatrixXd out = sign * A * covariance * A.transpose();
  out.diagonal().array() += 1.0;
  return out;
}

}  // namespace

Information::Information(const Eigen::VectorXd& prior)
    : covariance_(prior.cwiseInverse().asDiagonal()), ln_det_(prior.array().log().sum()) {}

void Information::add(const Eigen::MatrixXd& A) {
  if (A.rows() == 0) return;
  if (A.rows() >= A.cols()) {
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(A.cols(), A.cols());
    const Eigen::MatrixXd M = Cholesky(covariance_).solve(identity) + A.transpose() * A;
    const Cholesky llt(M);
    covariance_ = llt.solve(identity);
    ln_det_ = llt.ln_det();
    return;
  }
  const Cholesky llt(grown(A, covariance_, 1.0));
  const Eigen::MatrixXd half = llt.whitened(A * covariance_);
  covariance_ -= half.transpose() * half;
  ln_det_ += llt.ln_det();
}

void Information::remove(const Eigen::MatrixXd& A) {
  const Cholesky llt(grown(A, covariance_, -1.0));
  const Eigen::MatrixXd half = llt.whitened(A * covariance_);
  covariance_ += half.transpose() * half;
  ln_det_ += llt.ln_det();
}

double Information::gain(const Eigen::MatrixXd& A) const {
  return Cholesky(grown(A, covariance_, 1.0)).ln_det();
}

}  // namespace plumb::offline
