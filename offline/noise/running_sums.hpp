// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// Running sums over visits for a least-squares fit of the residual y by the motions of one part:
/// X^T X and X^T y, where X has one column for each number of the motion (at most 6). UX is U^T X
/// with the columns U of a model: who has such a model sums it, else it has no rows.
struct RunningSums {
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

  explicit RunningSums(Eigen::Index numbers, Eigen::Index model_columns = 0)
      : XX(Square::Zero(numbers, numbers)),
        Xy(Numbers::Zero(numbers)),
        UX(Eigen::MatrixXd::Zero(model_columns, numbers)) {}

  /// X: shape (axes, numbers); y: shape (axes,).
  template <class Motions, class Residual>
  void add(const Motions& X, const Residual& y) {
    XX.noalias() += X.transpose() * X;
    Xy.noalias() += X.transpose() * y;
  }

  Square XX;
  Numbers Xy;
  Eigen::MatrixXd UX;
};

}  // namespace plumb::offline
