// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/tree_domain.hpp"
#include "fit/tree_folds.hpp"
#include "fit/tree_jobs.hpp"
#include "fit/tree_trainer.hpp"
#include "fit/tree_validation.hpp"

namespace plumb::offline {
namespace {

/// Below so many poses a coefficient, a tree describes the noise: 45 poses on a six-axis arm look
/// five times better in-sample and are worse on fresh poses (the published experiment, on noise).
constexpr int kPosesPerCoefficient = 10;

using Sizes = std::array<int, format::kTreeAxes>;

/// Mean over folds and its standard error.
struct Mean {
  double value = 0.0;
  double se = 0.0;
};

Mean mean_of(const Eigen::VectorXd& x) {
  const double n = static_cast<double>(x.size()), mean = x.mean();
  return {mean, std::sqrt((x.array() - mean).square().sum() / (n * (n - 1.0)))};
}

/// Smallest size that the best one does not beat by more than a standard error.
int smallest_good_size(const Eigen::MatrixXd& squared_error) {
  Eigen::Index best = 0;
  squared_error.colwise().sum().minCoeff(&best);
  for (Eigen::Index k = 0; k < best; ++k) {
    const Mean excess = mean_of(squared_error.col(k) - squared_error.col(best));
    if (excess.value <= excess.se) return static_cast<int>(k);
  }
  return static_cast<int>(best);
}

/// Squared error of the chosen sizes, all axes, shape (folds,).
Eigen::VectorXd squared_error_of(const Validation& validation, const Sizes& sizes) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(validation.rows.size());
  for (int axis = 0; axis < format::kTreeAxes; ++axis)
    if (validation.has_axis(axis)) sum += validation.squared_error[axis].col(sizes[axis]);
  return sum;
}

/// RMS error before and after, and whether the fall is worth a correction.
struct Gain {
  double before = 0.0, after = 0.0;  // [m]
  double se = 0.0;                   // of the fall over folds [m]
  bool enough_share = false, beyond_se = false;
  double share() const { return before > 0.0 ? 1.0 - after / before : 0.0; }
  bool convinces() const { return enough_share && beyond_se; }
};

Gain gain_of(const Eigen::VectorXd& before, const Eigen::VectorXd& after,
             const Eigen::VectorXd& rows, double min_gain) {
  Gain out;
  out.before = std::sqrt(before.sum() / rows.sum());
  out.after = std::sqrt(after.sum() / rows.sum());
  const Mean fall =
      mean_of((before.array() / rows.array()).sqrt() - (after.array() / rows.array()).sqrt());
  out.se = fall.se;
  out.enough_share = out.share() > min_gain;
  out.beyond_se = fall.value > fall.se;
  return out;
}

/// Per axis; an axis whose own fall does not convince gets none.
Sizes sizes_by_axis(const Validation& validation, double min_gain) {
  Sizes out{};
  for (int axis = 0; axis < format::kTreeAxes; ++axis) {
    if (!validation.has_axis(axis)) continue;
    const Eigen::MatrixXd& error = validation.squared_error[axis];
    const int size = smallest_good_size(error);
    if (gain_of(error.col(0), error.col(size), validation.rows, min_gain).convinces())
      out[axis] = size;
  }
  return out;
}

std::string too_few(int poses, int joints) {
  return fmt::format(
      "{} poses cannot carry a local linear model of {} moving joints: its {} coefficients an axis "
      "need at least {} poses.",
      poses, joints, joints + 1, kPosesPerCoefficient * (joints + 1));
}

/// Share by which the error must fall. With few poses luck alone makes it fall by up to about
/// (coefficients + 2) / poses; asking for more keeps weak effects from making fresh poses worse by
/// 1 % in more than one data set of a hundred (tried with 2 and 6 joints, 30 to 1500 poses).
double asked_gain(double min_gain, int poses, int joints) {
  return std::max(min_gain, (joints + 3.0) / poses);
}

std::string why(const Gain& gain, const Sizes& sizes, double asked) {
  const std::string leaves = fmt::format("{} + {} + {} leaves", sizes[0], sizes[1], sizes[2]);
  const double percent = 100.0 * gain.share(), se = 100.0 * gain.se / gain.before;
  if (gain.convinces())
    return fmt::format(
        "Trees of {} lower the cross-validated RMS error from {:.4f} to {:.4f} mm ({:.1f} %, "
        "standard error {:.1f} %).",
        leaves, 1e3 * gain.before, 1e3 * gain.after, percent, se);
  if (sizes == Sizes{})
    return fmt::format(
        "No correction: on no axis does a tree lower the cross-validated error by more than {:.1f} "
        "% and one standard error.",
        100.0 * asked);
  if (!gain.enough_share)
    return fmt::format(
        "No correction: trees of {} lower the cross-validated error by {:.1f} %, and {:.1f} % is "
        "asked for.",
        leaves, percent, 100.0 * asked);
  return fmt::format(
      "No correction: trees of {} lower the cross-validated error by {:.1f} %, within one standard "
      "error ({:.1f} %) between folds.",
      leaves, percent, se);
}

void grow_chosen(const Samples& q, const Samples& residual, const GrowthLimits& limits,
                 const Sizes& sizes, TreeChoice& out) {
  const Samples u = normalised(out.domain, q);
  run_jobs(format::kTreeAxes, [&](int axis) {
    if (sizes[axis] == 0) return;
    GrowthLimits limit = limits;
    limit.max_leaves = sizes[axis];
    const GrownTree tree = grow(u, residual.col(axis), limit);
    out.trees[axis] = tree.cut(tree.leaves());
    out.leaves[axis] = tree.leaves();
  });
}

}  // namespace

TreeChoice choose_trees(const Samples& q, const Samples& residual,
                        const std::array<bool, 3>& axis_used, std::span<const int> group,
                        const TreeSettings& settings) {
  TreeChoice out;
  if (q.rows() == 0) {
    out.reason = too_few(0, static_cast<int>(q.cols()));
    return out;
  }
  out.domain = trained_box(q);
  const int poses = count_groups(group), joints = moving_joints(q);
  if (poses < kPosesPerCoefficient * (joints + 1)) {
    out.reason = too_few(poses, joints);
    return out;
  }
  const auto fold = deal_folds(q, residual, group, settings.folds, settings.seed);
  const Validation validation =
      cross_validate(q, residual, axis_used, fold, settings.folds, settings.growth);
  const double asked = asked_gain(settings.min_gain, poses, joints);
  const Sizes sizes = sizes_by_axis(validation, asked);
  const Eigen::VectorXd before = squared_error_of(validation, Sizes{});
  const Eigen::VectorXd after = squared_error_of(validation, sizes);
  const Gain gain = gain_of(before, after, validation.rows, asked);
  out.cv_before_m = gain.before;
  out.cv_after_m = gain.convinces() ? gain.after : gain.before;
  out.gain_se_m = gain.se;
  out.reason = why(gain, sizes, asked);
  if (gain.convinces()) grow_chosen(q, residual, settings.growth, sizes, out);
  return out;
}

}  // namespace plumb::offline
