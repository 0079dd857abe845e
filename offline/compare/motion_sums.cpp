// SPDX-License-Identifier: Apache-2.0
#include "compare/motion_sums.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace plumb::offline::compare {
namespace {

constexpr double kSeen = 1e-6;   // of the largest eigenvalue: directions below never show
constexpr double kRidge = 1e-9;  // of a segment in which some direction never shows

}  // namespace

MotionSums::MotionSums(const StepMotions& motions, MotionSource source, int joint)
    : source_(source), joint_(joint) {
  const int n = motions.size(), k = StepMotions::count(source);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(k, k);
  for (int i = 0; i < n; ++i) {
    columns_.emplace_back(motions.columns(i, source, joint));
    gram += columns_.back().transpose() * columns_.back();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram / std::max(1, n));
  combine_.resize(k, k);
  for (int i = 0; i < k; ++i) {
    const double size = eigen.eigenvalues()(i);
    if (size > kSeen * eigen.eigenvalues()(k - 1) && size > 1e-12)
      combine_.col(rank_++) = eigen.eigenvectors().col(i) / std::sqrt(size);
  }
  combine_.conservativeResize(k, rank_);
  for (auto& c : columns_) c = Columns(c * combine_);
}

void MotionSums::sum(const Eigen::Matrix3Xd& error) {
  gram_.assign(columns_.size() + 1, Square::Zero(rank_, rank_));
  along_.assign(columns_.size() + 1, Numbers::Zero(rank_));
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const auto& c = columns_[i];
    gram_[i + 1] = gram_[i] + c.transpose() * c;
    along_[i + 1] = along_[i] + c.transpose() * error.col(static_cast<Eigen::Index>(i));
  }
}

MotionSums::Numbers MotionSums::solve(int first, int last) const {
  Square gram = gram_[static_cast<std::size_t>(last)] - gram_[static_cast<std::size_t>(first)];
  gram.diagonal().array() += kRidge * (last - first);
  return gram.llt().solve(along_[static_cast<std::size_t>(last)] -
                          along_[static_cast<std::size_t>(first)]);
}

double MotionSums::explained(int first, int last) const {
  return solve(first, last)
      .dot(along_[static_cast<std::size_t>(last)] - along_[static_cast<std::size_t>(first)]);
}

}  // namespace plumb::offline::compare
