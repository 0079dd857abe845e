// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "compare/step_motions.hpp"

namespace plumb::offline::compare {

/// Least squares of the residual on the motions of one motion source, over any run of visits, from
/// running sums. Its columns are combined to independent ones of unit size first.
class MotionSums {
 public:
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6>;
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

  MotionSums(const StepMotions& motions, MotionSource source, int joint);

  MotionSource source() const { return source_; }
  int joint() const { return joint_; }
  int rank() const { return rank_; }  // 0: nothing moves
  const Columns& at(int visit) const { return columns_[static_cast<std::size_t>(visit)]; }

  /// Sums again for another residual, shape (3, visits).
  void sum(const Eigen::Matrix3Xd& error);

  /// Best numbers over the visits [first, last), and the sum of squares they explain.
  Numbers solve(int first, int last) const;
  double explained(int first, int last) const;

  /// The same in the units of StepMotions::columns.
  Eigen::VectorXd physical(const Numbers& numbers) const { return combine_ * numbers; }

 private:
  MotionSource source_;
  int joint_;
  int rank_ = 0;
  Eigen::MatrixXd combine_;
  std::vector<Columns> columns_;
  std::vector<Square> gram_;  // of the visits before
  std::vector<Numbers> along_;
};

}  // namespace plumb::offline::compare
