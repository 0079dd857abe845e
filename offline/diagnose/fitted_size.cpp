// SPDX-License-Identifier: Apache-2.0
#include "diagnose/fitted_size.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/cholesky.hpp"

namespace plumb::offline {
namespace {

constexpr int kTailSteps = 20;       // of iteratively reweighted least squares
constexpr double kSolvable = 1e-12;  // ridge, because columns may be linearly dependent

}  // namespace

FittedSize fitted_size(const RegressorScore& scored, const Eigen::VectorXd& prior, PriorTail tail) {
  const Eigen::Index b = scored.theta.size();
  FittedSize out{Eigen::VectorXd::Zero(b), Eigen::VectorXd::Zero(b)};
  if (scored.active.empty() || scored.folds.empty()) return out;
  const Products all = sum_of(scored.folds);
  const Eigen::MatrixXd gram = all.XX - all.UX.transpose() * all.UX;
  const Eigen::MatrixXd own = gram(scored.active, scored.active);
  const Eigen::VectorXd v = all.Xy(scored.active), sigma = prior(scored.active);
  const double left = scored.variance;
  const Eigen::VectorXd pull = (sigma.array() > 0.0).select(left / sigma.array().square(), 0.0);
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(own.rows()), weight = pull;
  Eigen::MatrixXd C;
  for (int step = 0; step < kTailSteps; ++step) {
    Eigen::MatrixXd sum = own;
    sum.diagonal() += weight;
    sum.diagonal().array() += kSolvable * std::max(own.diagonal().maxCoeff(), 1e-300);
    C = SymmetricSolver(sum).inverse();
    const Eigen::VectorXd next = C * v;
    const double change = (next - theta).norm();
    theta = next;
    if (tail == PriorTail::kNormal || change <= 1e-6 * theta.norm()) break;
    // The prior is Huber's: beyond one sigma its gradient is constant.
    for (Eigen::Index i = 0; i < theta.size(); ++i)
      if (sigma(i) > 0.0) weight(i) = pull(i) / std::max(1.0, std::abs(theta(i)) / sigma(i));
  }
  out.theta(scored.active) = theta;
  out.std(scored.active) = (left * C.diagonal().array().max(0.0)).sqrt().matrix();
  return out;
}

}  // namespace plumb::offline
