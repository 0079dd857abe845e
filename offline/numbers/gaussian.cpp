// SPDX-License-Identifier: Apache-2.0
#include "numbers/gaussian.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::offline {
namespace {

constexpr double kRoundingShare = 1e-12;  // of `before`: what is left after a perfect fit

}  // namespace

double ln_normal(const Eigen::VectorXd& x, const Cholesky& S) {
  return -0.5 * x.dot(S.solve(x)) - 0.5 * S.ln_det();
}

EvidenceGain evidence_gain(double ln_det, double before, double explained, double lines) {
  EvidenceGain out;
  out.after = std::max(before - explained, kRoundingShare * before);
  out.ln_bayes = -0.5 * ln_det - 0.5 * lines * std::log(out.after / before);
  return out;
}

LinearPosterior posterior(const Cholesky& S, const Eigen::MatrixXd& B,
                          const Eigen::VectorXd& prior) {
  const Eigen::MatrixXd SB = S.solve(B);
  const SymmetricSolver solver(with_prior(B.transpose() * SB, prior));
  return {solver.solve(SB.transpose()), solver.inverse()};
}

double ln_sum(std::span<const double> ln) {
  if (ln.empty()) return -HUGE_VAL;
  const double most = *std::max_element(ln.begin(), ln.end());
  double sum = 0.0;
  for (const double l : ln) sum += std::exp(l - most);
  return most + std::log(sum);
}

}  // namespace plumb::offline
