// SPDX-License-Identifier: Apache-2.0
#include "plan/information.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace plumb::offline {
namespace {

double ln_det(const Eigen::LLT<Eigen::MatrixXd>& llt) {
  return 2.0 * llt.matrixLLT().diagonal().array().log().sum();
}

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
    const auto identity = Eigen::MatrixXd::Identity(A.cols(), A.cols());
    const Eigen::MatrixXd M = covariance_.llt().solve(identity) + A.transpose() * A;
    const Eigen::LLT<Eigen::MatrixXd> llt(M);
    covariance_ = llt.solve(identity);
    ln_det_ = plumb::offline::ln_det(llt);
    return;
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(grown(A, covariance_, 1.0));
  const Eigen::MatrixXd half = llt.matrixL().solve(A * covariance_);
  covariance_ -= half.transpose() * half;
  ln_det_ += plumb::offline::ln_det(llt);
}

void Information::remove(const Eigen::MatrixXd& A) {
  const Eigen::LLT<Eigen::MatrixXd> llt(grown(A, covariance_, -1.0));
  const Eigen::MatrixXd half = llt.matrixL().solve(A * covariance_);
  covariance_ += half.transpose() * half;
  ln_det_ += plumb::offline::ln_det(llt);
}

double Information::gain(const Eigen::MatrixXd& A) const {
  return plumb::offline::ln_det(Eigen::LLT<Eigen::MatrixXd>(grown(A, covariance_, 1.0)));
}

}  // namespace plumb::offline
