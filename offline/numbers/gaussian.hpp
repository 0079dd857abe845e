// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "numbers/cholesky.hpp"

namespace plumb::offline {

/// ln of the normal density of x with zero mean and the covariance S, without the constant
/// -n/2 ln 2 pi.
double ln_normal(const Eigen::VectorXd& x, const Cholesky& S);

/// How much a linear model raises ln of the evidence of readings whose noise is known by some
/// degrees of freedom only (so that their distribution is Student's): [O'Hagan & Forster 2004, 11]
///   -1/2 ln det(I + prior information^-1 X^T X) - (lines / 2) ln(after / before)
struct EvidenceGain {
  double ln_bayes = 0.0;
  double after = 0.0;  // sum of squares that is left
};

/// ln_det: of the matrix above. before: sum of squares without the model, those of the known noise
/// included. explained: how much of it the model takes away. lines: degrees of freedom of `before`.
EvidenceGain evidence_gain(double ln_det, double before, double explained, double lines);

/// The normal matrix of least squares with a normal prior of zero mean beside the lines: every
/// number has the standard deviation `sigma` beforehand, and every line this variance.
template <class Matrix>
typename Matrix::PlainObject with_prior(const Eigen::MatrixBase<Matrix>& normal_matrix,
                                        double sigma = 1.0, double variance = 1.0) {
  typename Matrix::PlainObject out = normal_matrix.derived();
  out.diagonal().array() += variance / (sigma * sigma);
  return out;
}
/// The same where each number has its own standard deviation, and the lines the variance 1.
template <class Matrix>
typename Matrix::PlainObject with_prior(const Eigen::MatrixBase<Matrix>& normal_matrix,
                                        const Eigen::VectorXd& sigma) {
  typename Matrix::PlainObject out = normal_matrix.derived();
  out.diagonal() += sigma.array().square().inverse().matrix();
  return out;
}

/// x of r = B x + noise with noise ~ N(0, S) and x ~ N(0, diag(prior)^2): its mean is gain r.
struct LinearPosterior {
  Eigen::MatrixXd gain;        // (numbers, lines)
  Eigen::MatrixXd covariance;  // of x
};
LinearPosterior posterior(const Cholesky& S, const Eigen::MatrixXd& B,
                          const Eigen::VectorXd& prior);

/// ln of the sum of exp(ln), without overflow; -infinity for none.
double ln_sum(std::span<const double> ln);

}  // namespace plumb::offline
