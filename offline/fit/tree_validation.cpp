// SPDX-License-Identifier: Apache-2.0
#include "fit/tree_validation.hpp"

#include <algorithm>

#include "fit/tree_domain.hpp"
#include "fit/tree_folds.hpp"
#include "fit/tree_jobs.hpp"

namespace plumb::offline {
namespace {

struct FoldRows {
  std::vector<int> inside, held;
};

FoldRows rows_of_fold(const std::vector<int>& fold, int which) {
  FoldRows out;
  for (std::size_t i = 0; i < fold.size(); ++i)
    (fold[i] == which ? out.held : out.inside).push_back(static_cast<int>(i));
  return out;
}

Eigen::VectorXd validate_fold(const Samples& q, const Samples& y, const FoldRows& rows,
                              const GrowthLimits& limits) {
  const Samples q_inside = rows_of(q, rows.inside), q_held = rows_of(q, rows.held);
  const format::Domain box = trained_box(q_inside);
  const GrownTree tree = grow(normalised(box, q_inside), rows_of(y, rows.inside), limits);
  return error_by_size(tree, normalised(box, q_held), trust(box, q_held), rows_of(y, rows.held));
}

/// As many columns as every fold has sizes.
Eigen::MatrixXd stacked(const std::vector<Eigen::VectorXd>& curves) {
  Eigen::Index sizes = curves.front().size();
  for (const auto& curve : curves) sizes = std::min(sizes, curve.size());
  Eigen::MatrixXd out(curves.size(), sizes);
  for (std::size_t i = 0; i < curves.size(); ++i) out.row(i) = curves[i].head(sizes).transpose();
  return out;
}

}  // namespace

Validation cross_validate(const Samples& q, const Samples& residual,
                          const std::array<bool, 3>& axis_used, const std::vector<int>& fold,
                          int folds, const GrowthLimits& limits) {
  Validation out;
  out.rows.resize(folds);
  std::vector<FoldRows> rows;
  for (int f = 0; f < folds; ++f) {
    rows.push_back(rows_of_fold(fold, f));
    out.rows[f] = static_cast<double>(rows[f].held.size());
  }
  std::array<std::vector<Eigen::VectorXd>, 3> curves;
  for (auto& axis : curves) axis.resize(folds);
  run_jobs(3 * folds, [&](int job) {
    const int axis = job % 3, f = job / 3;
    if (axis_used[axis]) curves[axis][f] = validate_fold(q, residual.col(axis), rows[f], limits);
  });
  for (int axis = 0; axis < 3; ++axis)
    if (axis_used[axis]) out.squared_error[axis] = stacked(curves[axis]);
  return out;
}

Eigen::VectorXd error_by_size(const GrownTree& tree, const Samples& u, const Eigen::VectorXd& trust,
                              const Eigen::VectorXd& y) {
  const int sizes = tree.leaves() + 1;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(sizes);
  out[0] = y.squaredNorm();
  if (tree.leaves() == 0) return out;
  std::array<double, format::kMaxJoints> row;
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    for (Eigen::Index k = 0; k < u.cols(); ++k) row[k] = u(i, k);
    int size = 1, at = 0;
    while (size < sizes) {
      const TreeCell& cell = tree.cells[at];
      const double error =
          y[i] - trust[i] * cell.model.predict({row.data(), static_cast<std::size_t>(u.cols())});
      const int until = cell.input < 0 ? sizes : cell.split_at + 1;
      for (; size < until; ++size) out[size] += error * error;
      if (cell.input >= 0) at = row[cell.input] <= cell.threshold ? cell.low : cell.high;
    }
  }
  return out;
}

}  // namespace plumb::offline
