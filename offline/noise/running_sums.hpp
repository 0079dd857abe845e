// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// Running sums over visits for a least-squares fit of the residual y by the motions of one part:
/// X^T X and X^T y, where X has one column for each number of the motion (at most 6). UX is U^T X
/// with the columns U of a model, and has no rows if there is no model.
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

  /// Adds to UX, from row `first` on, the part of some columns of the model. They are stored as
  /// rows, because the lines of a visit are read together: shape (columns, axes).
  template <class Model, class Motions>
  void add_model(Eigen::Index first, const Model& Ut, const Motions& X) {
    UX.middleRows(first, Ut.rows()) += Ut.lazyProduct(X);
  }

  Square XX;
  Numbers Xy;
  Eigen::MatrixXd UX;
};

}  // namespace plumb::offline
