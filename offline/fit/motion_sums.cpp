// SPDX-License-Identifier: Apache-2.0
#include "fit/motion_sums.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "numbers/spectrum.hpp"

namespace plumb::offline {
namespace {

constexpr double kSeen = 1e-6;   // share of the largest eigenvalue: smaller ones are unobservable
constexpr double kRidge = 1e-9;  // keeps segments solvable in which a direction is unobservable

}  // namespace

MotionSums::MotionSums(const StepMotions& motions, const MovingPart& part) : part_(part) {
  const int n = motions.size(), k = numbers_of(part.source);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(k, k);
  for (int i = 0; i < n; ++i) {
    columns_.emplace_back(motions.columns(i, part.source, part.joint));
    gram += columns_.back().transpose() * columns_.back();
  }
  const SymmetricEigen eigen = symmetric_eigen(gram / std::max(1, n));
  combine_.resize(k, k);
  for (int i = 0; i < k; ++i) {
    const double size = eigen.values(i);
    if (size > kSeen * eigen.values(k - 1) && size > 1e-12)
      combine_.col(rank_++) = eigen.vectors.col(i) / std::sqrt(size);
  }
  combine_.conservativeResize(k, rank_);
  for (auto& c : columns_) c = Columns(c * combine_);
}

void MotionSums::sum(const Eigen::Matrix3Xd& error) {
  before_.assign(columns_.size() + 1, RunningSums(rank_));
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    before_[i + 1] = before_[i];
    before_[i + 1].add(columns_[i], error.col(static_cast<Eigen::Index>(i)));
  }
}

MotionSums::Numbers MotionSums::solve(int first, int last) const {
  Square gram =
      before_[static_cast<std::size_t>(last)].XX - before_[static_cast<std::size_t>(first)].XX;
  gram.diagonal().array() += kRidge * (last - first);
  return gram.llt().solve(before_[static_cast<std::size_t>(last)].Xy -
                          before_[static_cast<std::size_t>(first)].Xy);
}

double MotionSums::explained(int first, int last) const {
  return solve(first, last)
      .dot(before_[static_cast<std::size_t>(last)].Xy -
           before_[static_cast<std::size_t>(first)].Xy);
}

}  // namespace plumb::offline
