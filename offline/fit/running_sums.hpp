// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// Running sums, visit by visit, of what least squares needs of the motions of one part: X has a
/// column for each of its numbers (at most 6), y is the residual. `UX` is what the columns U of a
/// model have in common with the motions, and empty where no model is looked at.
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

  /// The same beside the columns of a model, shape (axes, model_columns).
  template <class Motions, class Residual, class Model>
  void add(const Motions& X, const Residual& y, const Model& U) {
    add(X, y);
    UX.noalias() += U.transpose() * X;
  }

  Square XX;
  Numbers Xy;
  Eigen::MatrixXd UX;
};

}  // namespace plumb::offline
