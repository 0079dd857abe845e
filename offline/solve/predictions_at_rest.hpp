// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace plumb::offline {

/// Whether the predictions of a fit have come to rest, judged by its cost after each iteration,
/// which is half a sum of squares in standard deviations. Numbers that the poses hardly show may
/// still wander then, but what is predicted at these poses no longer changes.
///
/// Near its minimum, cost - least cost = |J dx|^2 / 2: a fall of the cost tells how far the
/// predictions moved.
class PredictionsAtRest {
 public:
  /// residuals: how many coordinates are fitted.
  explicit PredictionsAtRest(int residuals) : residuals_(residuals) {}

  /// The cost at the start, then after every iteration.
  void add(double cost) { costs_.push_back(cost); }

  /// True after many iterations if the last ones moved the predictions so little that more of them
  /// are not worth their time: the fit has converged and may end.
  bool may_end() const;

  /// True if the last iterations moved the predictions by little beside the noise: a fit that has
  /// used all its iterations counts as converged.
  bool nearly() const;

 private:
  double recent_motion() const;

  int residuals_;
  std::vector<double> costs_;
};

}  // namespace plumb::offline
