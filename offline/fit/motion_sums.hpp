// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/moving_part.hpp"
#include "fit/running_sums.hpp"
#include "fit/step_motions.hpp"

namespace plumb::offline {

/// Least-squares fit of the residual by the motions of one part, over any run of visits, from
/// running sums. The columns are first combined into independent ones of unit mean square.
class MotionSums {
 public:
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6>;
  using Square = RunningSums::Square;
  using Numbers = RunningSums::Numbers;

  MotionSums(const StepMotions& motions, const MovingPart& part);

  MotionSource source() const { return part_.source; }
  int joint() const { return part_.joint; }
  int rank() const { return rank_; }  // 0: nothing moves
  const Columns& at(int visit) const { return columns_[static_cast<std::size_t>(visit)]; }

  /// Computes the sums for this residual, shape (3, visits) [m].
  void sum(const Eigen::Matrix3Xd& error);

  /// Least-squares parameters over the visits [first, last), and the sum of squares they explain.
  Numbers solve(int first, int last) const;
  double explained(int first, int last) const;
  /// Sum of squares explained by separate parameters on the two sides of a cut.
  double gain(int first, int cut, int last) const {
    return explained(first, cut) + explained(cut, last);
  }

  /// Converts parameters of `solve` into the units of StepMotions::columns.
  Eigen::VectorXd physical(const Numbers& numbers) const { return combine_ * numbers; }

 private:
  MovingPart part_;
  int rank_ = 0;
  Eigen::MatrixXd combine_;
  std::vector<Columns> columns_;
  std::vector<RunningSums> before_;  // sums over the visits before each one
};

}  // namespace plumb::offline
