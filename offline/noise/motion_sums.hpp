// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "noise/moving_part.hpp"
#include "noise/running_sums.hpp"
#include "noise/step_motions.hpp"

namespace plumb::offline {

/// Least-squares fit of the residual by the motions of one part, over any run of visits, from
/// running sums. The columns are first combined into independent ones of unit mean square. Of the
/// sums every 256th is kept, and those of one block of visits, so that a million visits need little
/// memory: ask for them in order.
class MotionSums {
 public:
  using Columns = StepMotions::Columns;
  using Square = RunningSums::Square;
  using Numbers = RunningSums::Numbers;

  /// Keeps a reference to `motions`.
  MotionSums(const StepMotions& motions, const MovingPart& part);

  MotionSource source() const { return part_.source; }
  int joint() const { return part_.joint; }
  int rank() const { return rank_; }  // 0: nothing moves
  Columns at(int visit) const {
    return motions_->columns(visit, part_.source, part_.joint) * combine_;
  }

  /// Computes the sums for this residual, shape (3, visits) [m], which must stay as it is as long
  /// as they are asked for.
  void sum(const Eigen::Matrix3Xd& error);

  /// Sums over the visits before this one.
  RunningSums before(int visit) const;

  /// Least-squares parameters over the visits [first, last), and the sum of squares they explain.
  Numbers solve(int first, int last) const;
  double explained(int first, int last) const;

  /// Sum of squares explained by separate parameters on the two sides of a cut of these visits.
  class Gain {
   public:
    Gain(const MotionSums& sums, int first, int last)
        : sums_(sums),
          first_(first),
          last_(last),
          to_(sums.before(last)),
          from_(sums.before(first)) {}
    double operator()(int cut) const {
      const RunningSums& at = sums_.cached(cut);
      return explained(from_, at, cut - first_) + explained(at, to_, last_ - cut);
    }
    /// By the same parameters on both.
    double whole() const { return explained(from_, to_, last_ - first_); }

   private:
    const MotionSums& sums_;
    int first_, last_;
    RunningSums to_, from_;
  };

  /// Converts parameters of `solve` into the units of StepMotions::columns.
  Eigen::VectorXd physical(const Numbers& numbers) const { return combine_ * numbers; }

 private:
  static Numbers solve(const RunningSums& from, const RunningSums& to, int visits);
  static double explained(const RunningSums& from, const RunningSums& to, int visits);
  /// As before(visit); until the next call.
  const RunningSums& cached(int visit) const;

  const StepMotions* motions_;
  MovingPart part_;
  int rank_ = 0;
  Square combine_;
  const Eigen::Matrix3Xd* error_ = nullptr;
  std::vector<RunningSums> before_;         // the visits before each 256th
  mutable std::vector<RunningSums> block_;  // before each of one block of visits
  mutable int block_number_ = -1;
};

}  // namespace plumb::offline
