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

/// How strongly the reading of each pose pulls its own prediction: its block of the hat matrix
///
///   H = J (J^T J)^-1 J^T
///
/// at a solution. Memory: the square of the lines of a pose, for every pose.
/// [Cook & Weisberg 1982]
class Leverage {
 public:
  /// `at` holds its whole Jacobian. If that has no columns, nothing was fitted and H is 0.
  Leverage(const FitData& data, const Solution& at);

  /// The same of a solution of `parameters` that may hold only the triangle of its Jacobian (see
  /// is_many). Cost: one evaluation, and poses * parameters^2.
  Leverage(const FitData& data, const Solution& at, const std::vector<Parameter>& parameters);

  /// Deletion distances (see deletion_distances) of the rows of a later solution. They are
  /// approximate if that solution was fitted to fewer rows than this one. The lists of rows must be
  /// equal or both ascend; a row that this solution did not have keeps its plain distance.
  Eigen::VectorXd distances(const FitData& data, const Solution& now) const;

 private:
  explicit Leverage(const FitData& data);
  void from_jacobian(const Solution& at);
  template <class Lines>
  void put(Eigen::Index pose, const Lines& orthonormal);

  std::vector<int> rows_;
  LineTable table_;
  Eigen::MatrixXd hat_;  // shape (table_.most()^2, rows)
};

}  // namespace plumb::offline
