// SPDX-License-Identifier: Apache-2.0
#include "noise/motion_sums.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "numbers/spectrum.hpp"

namespace plumb::offline {
namespace {

constexpr double kSeen = 1e-6;   // share of the largest eigenvalue: smaller ones are unobservable
constexpr int kBlock = 256;      // visits
constexpr double kRidge = 1e-9;  // keeps segments solvable in which a direction is unobservable

}  // namespace

MotionSums::MotionSums(const StepMotions& motions, const MovingPart& part)
    : motions_(&motions), part_(part) {
  const int n = motions.size(), k = numbers_of(part.source);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(k, k);
  for (int i = 0; i < n; ++i) {
    const Columns c = motions.columns(i, part.source, part.joint);
    gram.noalias() += c.transpose() * c;
  }
  const SymmetricEigen eigen = symmetric_eigen(gram / std::max(1, n));
  combine_.resize(k, k);
  for (int i = 0; i < k; ++i) {
    const double size = eigen.values(i);
    if (size > kSeen * eigen.values(k - 1) && size > 1e-12)
      combine_.col(rank_++) = eigen.vectors.col(i) / std::sqrt(size);
  }
  combine_.conservativeResize(k, rank_);
}

void MotionSums::sum(const Eigen::Matrix3Xd& error) {
  error_ = &error;
  block_number_ = -1;
  before_.clear();
  RunningSums sums(rank_);
  for (int i = 0; i < motions_->size(); ++i) {
    if (i % kBlock == 0) before_.push_back(sums);
    sums.add(at(i), error.col(i));
  }
  if (motions_->size() % kBlock == 0) before_.push_back(sums);
}

const RunningSums& MotionSums::cached(int visit) const {
  if (visit / kBlock != block_number_) {
    block_number_ = visit / kBlock;
    block_.assign(1, before_[static_cast<std::size_t>(block_number_)]);
    const int first = block_number_ * kBlock;
    for (int i = first; i < std::min(motions_->size(), first + kBlock - 1); ++i) {
      block_.push_back(block_.back());
      block_.back().add(at(i), error_->col(i));
    }
  }
  return block_[static_cast<std::size_t>(visit % kBlock)];
}

RunningSums MotionSums::before(int visit) const { return cached(visit); }

MotionSums::Numbers MotionSums::solve(const RunningSums& from, const RunningSums& to, int visits) {
  Square gram = to.XX - from.XX;
  gram.diagonal().array() += kRidge * visits;
  return gram.llt().solve(to.Xy - from.Xy);
}

double MotionSums::explained(const RunningSums& from, const RunningSums& to, int visits) {
  return solve(from, to, visits).dot(to.Xy - from.Xy);
}

MotionSums::Numbers MotionSums::solve(int first, int last) const {
  const RunningSums from = before(first);
  return solve(from, cached(last), last - first);
}

double MotionSums::explained(int first, int last) const {
  const RunningSums from = before(first);
  return explained(from, cached(last), last - first);
}

}  // namespace plumb::offline
