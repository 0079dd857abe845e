// SPDX-License-Identifier: Apache-2.0
#include "tree/validation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/jobs.hpp"
#include "plumb/runtime/detail/tree.hpp"
#include "tree/blended_path.hpp"
#include "tree/domain.hpp"
#include "tree/folds.hpp"

namespace plumb::offline {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLeafLadder = 1.35;   // ratio of successive sizes of a blended tree
constexpr int kMostUnknowns = 900;     // of a blended tree in validation: about 1 s for each fold
constexpr double kClearlyWorse = 1.5;  // times the smallest squared error of the fold so far
constexpr int kPatience = 3;           // growth stops after so many clearly worse sizes in a row
constexpr std::array kRidges{1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1};

struct FoldRows {
  std::vector<int> inside, held;
};

FoldRows rows_of_fold(const std::vector<int>& fold, int which) {
  FoldRows out;
  for (std::size_t i = 0; i < fold.size(); ++i)
    (fold[i] == which ? out.held : out.inside).push_back(static_cast<int>(i));
  return out;
}

std::vector<FoldRows> rows_of_folds(const FoldedSamples& samples, Validation& out) {
  std::vector<FoldRows> rows;
  out.rows.resize(samples.folds);
  for (int f = 0; f < samples.folds; ++f) {
    rows.push_back(rows_of_fold(samples.fold, f));
    out.rows[f] = static_cast<double>(rows[f].held.size());
  }
  return rows;
}

Eigen::VectorXd validate_crisp_fold(const Samples& q, const Samples& y, const FoldRows& rows,
                                    const GrowthSettings& growth) {
  const Samples q_inside = rows_of(q, rows.inside), q_held = rows_of(q, rows.held);
  const format::Domain box = trained_box(q_inside);
  const GrownTree tree = grow(normalised(box, q_inside), rows_of(y, rows.inside), growth);
  return error_by_size(tree, normalised(box, q_held), trust(box, q_held), rows_of(y, rows.held));
}

/// The curves of all folds as rows, cut to the number of sizes that every fold has.
Eigen::MatrixXd stacked(const std::vector<Eigen::VectorXd>& curves) {
  Eigen::Index sizes = curves.front().size();
  for (const auto& curve : curves) sizes = std::min(sizes, curve.size());
  Eigen::MatrixXd out(curves.size(), sizes);
  for (std::size_t i = 0; i < curves.size(); ++i) out.row(i) = curves[i].head(sizes).transpose();
  return out;
}

/// The sizes that are tried: 1, 2, 3, 4, 6, ... up to `most`.
std::vector<int> sizes_up_to(int most) {
  std::vector<int> out;
  for (int k = 1; k <= most; k = std::max(k + 1, static_cast<int>(std::lround(k * kLeafLadder))))
    out.push_back(k);
  if (!out.empty() && out.back() < most) out.push_back(most);
  return out;
}

std::vector<TreeCandidate> ladder(int inputs, int degree, int most_leaves, std::size_t rows) {
  const auto terms = format::leaf_terms(inputs, degree);
  const auto unknowns = std::min<std::size_t>(kMostUnknowns, rows / 2);
  std::vector<TreeCandidate> out;
  for (int leaves : sizes_up_to(std::min(most_leaves, static_cast<int>(unknowns / terms))))
    for (double ridge : kRidges) out.push_back({degree, leaves, ridge});
  return out;
}

/// One fold of blended trees that share their splits over the columns of y.
class BlendedFold {
 public:
  BlendedFold(const Samples& q, const Samples& y, const FoldRows& rows)
      : inside_(rows_of(q, rows.inside)),
        y_inside_(rows_of(y, rows.inside)),
        y_held_(rows_of(y, rows.held)) {
    const format::Domain box = trained_box(inside_);
    inside_ = normalised(box, inside_);
    const Samples q_held = rows_of(q, rows.held);
    held_ = normalised(box, q_held);
    trust_ = trust(box, q_held);
  }

  /// The errors of every candidate, shape (held-out rows, outputs); empty for those that were not
  /// tried.
  std::vector<Samples> run(const std::vector<TreeCandidate>& candidates,
                           const GrowthSettings& growth) const {
    std::vector<Samples> out(candidates.size());
    out[0] = y_held_;
    for (int degree = 1; degree <= growth.degree; ++degree)
      run_degree(degree, candidates, growth, out);
    return out;
  }

 private:
  void run_degree(int degree, const std::vector<TreeCandidate>& candidates,
                  const GrowthSettings& growth, std::vector<Samples>& out) const {
    BlendSettings settings{.growth = growth};
    settings.growth.degree = degree;
    BlendedPath path(inside_, y_inside_, settings);
    double best = kNever, at_this_size = kNever;
    int worse = 0, size = 0;
    for (std::size_t c = 1; c < candidates.size(); ++c) {
      const TreeCandidate& candidate = candidates[c];
      if (candidate.degree != degree) continue;
      if (candidate.leaves != size) {
        worse = size > 0 && at_this_size > kClearlyWorse * best ? worse + 1 : 0;
        if (worse == kPatience || !path.grow_to(candidate.leaves)) return;
        size = candidate.leaves;
        at_this_size = kNever;
      }
      out[c] = errors(path.solve(candidate.ridge));
      at_this_size = std::min(at_this_size, out[c].squaredNorm());
      best = std::min(best, at_this_size);
    }
  }

  Samples errors(const std::vector<format::Tree>& trees) const {
    const int inputs = static_cast<int>(held_.cols());
    std::vector<TreeView> views;
    for (const auto& tree : trees) views.emplace_back(tree, inputs);
    Samples out = y_held_;
    ActiveLeaves<double> active;
    for (Eigen::Index i = 0; i < held_.rows(); ++i) {
      const SampleRow row(held_, i);
      views[0].active(row.span(), active);
      for (std::size_t k = 0; k < views.size(); ++k)
        out(i, static_cast<Eigen::Index>(k)) -= trust_[i] * views[k].evaluate(row.span(), active);
    }
    return out;
  }

  Samples inside_, y_inside_, held_, y_held_;
  Eigen::VectorXd trust_;
};

void keep(const std::vector<Samples>& errors, const FoldRows& rows, const std::vector<int>& axes,
          int fold, Validation& out) {
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    for (std::size_t c = 0; c < errors.size(); ++c) {
      const auto at = static_cast<Eigen::Index>(c);
      const bool has = errors[c].size() > 0;
      out.squared_error[axes[k]](fold, at) = has ? errors[c].col(column).squaredNorm() : kNever;
      for (std::size_t i = 0; i < rows.held.size() && has; ++i)
        out.error[axes[k]](rows.held[i], at) =
            static_cast<float>(errors[c](static_cast<Eigen::Index>(i), column));
    }
  }
}

}  // namespace

UsedAxes used_axes(const Samples& residual, const std::array<bool, 3>& axis_used) {
  UsedAxes out;
  for (int axis = 0; axis < format::kTreeAxes; ++axis)
    if (axis_used[axis]) out.axis.push_back(axis);
  out.y.resize(residual.rows(), static_cast<Eigen::Index>(out.axis.size()));
  for (std::size_t k = 0; k < out.axis.size(); ++k)
    out.y.col(static_cast<Eigen::Index>(k)) = residual.col(out.axis[k]);
  return out;
}

Validation validate_crisp(const FoldedSamples& samples, const GrowthSettings& growth) {
  Validation out;
  const auto rows = rows_of_folds(samples, out);
  std::array<std::vector<Eigen::VectorXd>, 3> curves;
  for (auto& axis : curves) axis.resize(samples.folds);
  run_jobs(3 * samples.folds, [&](int job) {
    const int axis = job % 3, f = job / 3;
    if (samples.axis_used[axis])
      curves[axis][f] = validate_crisp_fold(samples.q, samples.residual.col(axis), rows[f], growth);
  });
  Eigen::Index sizes = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (samples.axis_used[axis]) {
      out.squared_error[axis] = stacked(curves[axis]);
      sizes = std::max(sizes, out.squared_error[axis].cols());
    }
  for (int k = 0; k < sizes; ++k) out.candidates.push_back({growth.degree, k, 0.0});
  return out;
}

Validation validate_blended(const FoldedSamples& samples, const GrowthSettings& growth,
                            Sharing sharing) {
  Validation out;
  const auto rows = rows_of_folds(samples, out);
  const UsedAxes used = used_axes(samples.residual, samples.axis_used);
  std::size_t fewest = samples.fold.size();
  for (const auto& fold : rows) fewest = std::min(fewest, fold.inside.size());
  out.candidates.push_back({});
  const int inputs = static_cast<int>(samples.q.cols());
  for (int degree = 1; degree <= growth.degree; ++degree)
    for (const auto& candidate : ladder(inputs, degree, growth.max_leaves, fewest))
      out.candidates.push_back(candidate);
  const auto count = static_cast<Eigen::Index>(out.candidates.size());
  for (int axis : used.axis) {
    out.squared_error[axis].resize(samples.folds, count);
    out.error[axis].setZero(samples.q.rows(), count);
  }
  const bool shared = sharing == Sharing::kShared;
  const int trees = shared ? 1 : static_cast<int>(used.axis.size());
  run_jobs(trees * samples.folds, [&](int job) {
    const int f = job / trees, tree = job % trees;
    const Samples y = shared ? used.y : Samples(used.y.col(tree));
    const std::vector<int> axes = shared ? used.axis : std::vector<int>{used.axis[tree]};
    keep(BlendedFold(samples.q, y, rows[f]).run(out.candidates, growth), rows[f], axes, f, out);
  });
  return out;
}

Eigen::VectorXd error_by_size(const GrownTree& tree, const Samples& u, const Eigen::VectorXd& trust,
                              const Eigen::VectorXd& y) {
  const int sizes = tree.leaves() + 1;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(sizes);
  out[0] = y.squaredNorm();
  if (tree.leaves() == 0) return out;
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    const SampleRow row(u, i);
    int size = 1, at = 0;
    while (size < sizes) {
      const TreeCell& cell = tree.cells[at];
      const double error = y[i] - trust[i] * tree.predict(at, row.span(), 0);
      const int until = cell.is_split() ? cell.split_at + 1 : sizes;
      for (; size < until; ++size) out[size] += error * error;
      if (cell.is_split())
        at = cell.split_value(row.span()) <= cell.threshold ? cell.low : cell.high;
    }
  }
  return out;
}

}  // namespace plumb::offline
