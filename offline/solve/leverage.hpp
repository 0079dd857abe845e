// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// Whitened distance of every row of `data` from the prediction, shape (rows,).
Eigen::VectorXd plain_distances(const FitData& data, const Solution& at);

/// How much each pose decides its own prediction: its block of the hat matrix
///
///   H = J (J^T J)^-1 J^T
///
/// at a solution. Memory: the square of the lines of a pose, for every pose.
/// [Cook & Weisberg 1982]
class Leverage {
 public:
  /// `at`: with its Jacobian, or with none: then nothing was fitted.
  Leverage(const FitData& data, const Solution& at);

  /// The same of a solution of `parameters`, whose Jacobian may be only its triangle (see is_many).
  /// Cost: an evaluation, and poses * parameters^2.
  Leverage(const FitData& data, const Solution& at, const std::vector<Parameter>& parameters);

  /// Deletion distances (see deletion_distances) of the rows of a later solution. Where that was
  /// fitted without some of the rows that were there before, they are a close guess. Both lists of
  /// rows ascend, or they are the same one; a row that was not there keeps its plain distance.
  Eigen::VectorXd distances(const FitData& data, const Solution& now) const;

 private:
  explicit Leverage(const FitData& data);
  void from_jacobian(const Solution& at);
  template <class Lines>
  void put(Eigen::Index pose, const Lines& orthonormal);

  std::vector<int> rows_;
  Eigen::Index lines_;   // of a pose
  Eigen::MatrixXd hat_;  // shape (lines_^2, rows)
};

}  // namespace plumb::offline
