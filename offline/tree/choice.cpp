// SPDX-License-Identifier: Apache-2.0
#include "tree/choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/jobs.hpp"
#include "plumb/runtime/detail/tree.hpp"
#include "tree/domain.hpp"
#include "tree/folds.hpp"
#include "tree/rows.hpp"
#include "tree/validation.hpp"

namespace plumb::offline {
namespace {

/// With fewer poses per coefficient a tree fits the noise. In the published experiment, repeated
/// with pure noise on 45 poses of a six-axis arm, the error is five times smaller in-sample and
/// larger on fresh poses.
constexpr int kPosesPerCoefficient = 10;

/// Largest depth of crisp trees. The cycle always makes as many comparisons as the deepest leaf
/// needs, so a few more leaves elsewhere cost less than a single deep one.
constexpr int kCrispDepth = 10;
/// Crisp trees are taken if their error is below this share of that of blended ones. Chosen.
constexpr double kCrispMustGain = 0.95;

using Chosen = std::array<int, format::kTreeAxes>;  // index of the candidate for each axis

/// Mean over folds and its standard error.
struct Mean {
  double value = 0.0;
  double se = 0.0;
};

Mean mean_of(const Eigen::VectorXd& x) {
  const double n = static_cast<double>(x.size()), mean = x.mean();
  return {mean, std::sqrt((x.array() - mean).square().sum() / (n * (n - 1.0)))};
}

/// The logarithm of squared errors. Folds without any error get the smallest possible value.
Eigen::VectorXd logarithm(const Eigen::VectorXd& squared_error) {
  return squared_error.array().max(std::numeric_limits<double>::min()).log();
}

/// Among the candidates whose error exceeds the best one's by at most one standard error, the one
/// with the fewest coefficients, and among those of equal size the one with the smallest error.
/// Ratios of errors are compared, so that a fold that is difficult for all candidates hides no
/// difference. squared_error: (folds, candidates).
int smallest_good(const Eigen::MatrixXd& squared_error,
                  const std::vector<TreeCandidate>& candidates, int inputs) {
  const Eigen::VectorXd total = squared_error.colwise().sum();
  Eigen::Index best = 0;
  total.minCoeff(&best);
  const auto order = [&](Eigen::Index k) {
    return std::pair(candidates[k].coefficients(inputs), total[k]);
  };
  Eigen::Index out = best;
  for (Eigen::Index k = 0; k < total.size(); ++k) {
    if (!std::isfinite(total[k]) || !(order(k) < order(out))) continue;
    const Mean excess =
        mean_of(logarithm(squared_error.col(k)) - logarithm(squared_error.col(best)));
    if (excess.value <= excess.se) out = k;
  }
  return static_cast<int>(out);
}

/// Squared error of the chosen candidates, all axes, shape (folds,).
Eigen::VectorXd squared_error_of(const Validation& validation, const Chosen& chosen) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(validation.rows.size());
  for (int axis = 0; axis < format::kTreeAxes; ++axis)
    if (validation.has_axis(axis)) sum += validation.squared_error[axis].col(chosen[axis]);
  return sum;
}

/// The RMS error before and after, and whether the reduction justifies a correction.
struct Gain {
  double before = 0.0, after = 0.0;  // [m]
  double se = 0.0;                   // standard error of the reduction over the folds [m]
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

/// The best candidate of every axis, or the one that is best for all axes together.
Chosen best_of(const Validation& validation, Sharing sharing, int inputs) {
  Chosen out{};
  Eigen::MatrixXd sum;
  for (int axis = 0; axis < format::kTreeAxes; ++axis) {
    if (!validation.has_axis(axis)) continue;
    const Eigen::MatrixXd& error = validation.squared_error[axis];
    out[axis] = smallest_good(error, validation.candidates, inputs);
    if (sharing == Sharing::kOwn) continue;
    sum = sum.size() == 0 ? error : Eigen::MatrixXd(sum + error);
  }
  if (sum.size() > 0) out.fill(smallest_good(sum, validation.candidates, inputs));
  return out;
}

/// The choice without trees for the axes on which the reduction is not significant.
Chosen convincing(const Validation& validation, Chosen chosen, double min_gain) {
  for (int axis = 0; axis < format::kTreeAxes; ++axis) {
    if (!validation.has_axis(axis)) {
      chosen[axis] = 0;
      continue;
    }
    const Eigen::MatrixXd& error = validation.squared_error[axis];
    if (!gain_of(error.col(0), error.col(chosen[axis]), validation.rows, min_gain).convinces())
      chosen[axis] = 0;
  }
  return chosen;
}

std::string too_few(int poses, int joints) {
  return fmt::format(
      "{} poses cannot carry a local linear model of {} moving joints: its {} coefficients an axis "
      "need at least {} poses.",
      poses, joints, joints + 1, kPosesPerCoefficient * (joints + 1));
}

/// The share by which the error must be reduced. With few poses chance alone reduces it by up to
/// about (coefficients + 2) / poses. With the larger share that is required here, weak effects make
/// fresh poses worse by 1 % in at most one data set of a hundred (tried with 2 and 6 joints, 30 to
/// 1500 poses).
double asked_gain(double min_gain, int poses, int joints) {
  return std::max(min_gain, (joints + 3.0) / poses);
}

std::string words_for(const Validation& validation, const Chosen& chosen, TreeForm form) {
  std::vector<std::string> leaves;
  int degree = 1;
  for (int k : chosen) {
    leaves.push_back(fmt::format("{}", validation.candidates[k].leaves));
    degree = std::max(degree, validation.candidates[k].degree);
  }
  return fmt::format("{} trees of {} {} leaves", form == TreeForm::kBlended ? "Blended" : "Crisp",
                     fmt::join(leaves, " + "), degree == 2 ? "quadratic" : "affine");
}

std::string why(const Gain& gain, const std::string& trees, bool any, double asked) {
  const double percent = 100.0 * gain.share(), se = 100.0 * gain.se / gain.before;
  if (!any)
    return fmt::format(
        "No correction: on no axis does a tree lower the cross-validated error by more than {:.1f} "
        "% and one standard error.",
        100.0 * asked);
  if (gain.convinces())
    return fmt::format(
        "{} lower the cross-validated RMS error from {:.4f} to {:.4f} mm ({:.1f} %, standard error "
        "{:.1f} %).",
        trees, 1e3 * gain.before, 1e3 * gain.after, percent, se);
  if (!gain.enough_share)
    return fmt::format(
        "No correction: the best trees lower the cross-validated error by {:.1f} %, and {:.1f} % "
        "is asked for.",
        percent, 100.0 * asked);
  return fmt::format(
      "No correction: the best trees lower the cross-validated error by {:.1f} %, within one "
      "standard error ({:.1f} %) between folds.",
      percent, se);
}

GrowthSettings growth_of(const TreeSettings& settings, int degree) {
  GrowthSettings out = settings.form == TreeForm::kBlended ? kBlendedGrowth : GrowthSettings{};
  out.max_leaves = settings.max_leaves;
  out.min_samples = settings.min_samples;
  out.degree = degree;
  if (settings.form == TreeForm::kCrisp) out.max_depth = kCrispDepth;
  return out;
}

format::Tree crisp_tree(const Samples& u, const Samples& y, const TreeSettings& settings,
                        const TreeCandidate& candidate) {
  GrowthSettings growth = growth_of(settings, candidate.degree);
  growth.max_leaves = candidate.leaves;
  const GrownTree tree = grow(u, y, growth);
  return tree.cut(tree.leaves());
}

std::vector<format::Tree> blended_trees(const Samples& u, const Samples& y,
                                        const TreeSettings& settings,
                                        const TreeCandidate& candidate) {
  BlendSettings blend{.growth = growth_of(settings, candidate.degree)};
  BlendedPath path(u, y, blend);
  path.grow_to(candidate.leaves);
  auto out = path.solve(candidate.ridge);
  add_regions(out[0], u);
  for (auto& tree : out) tree.region = out[0].region;  // all axes have the same leaves
  return out;
}

/// Adds the error to expect in each leaf: the RMS of the held-out errors, weighted by the validity
/// of the leaf.
void add_sigma(const Samples& u, const Eigen::VectorXf& error, format::Tree& tree) {
  const TreeView view(tree, static_cast<int>(u.cols()));
  std::vector<double> sum(tree.leaves(), 0.0), weight(tree.leaves(), 0.0);
  ActiveLeaves<double> active;
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    view.active(SampleRow(u, i).span(), active);
    const double e = static_cast<double>(error[i]);
    for (int k = 0; k < active.count; ++k) {
      sum[active.leaf[k]] += active.weight[k] * e * e;
      weight[active.leaf[k]] += active.weight[k];
    }
  }
  tree.sigma.clear();
  for (std::size_t k = 0; k < sum.size(); ++k)
    tree.sigma.push_back(static_cast<float>(weight[k] > 0.0 ? std::sqrt(sum[k] / weight[k]) : 0.0));
}

void grow_shared(const Samples& u, const Samples& residual, const Validation& validation,
                 const Chosen& chosen, const TreeSettings& settings, TreeChoice& out) {
  std::array<bool, 3> measured{};
  for (int axis = 0; axis < format::kTreeAxes; ++axis) measured[axis] = validation.has_axis(axis);
  const UsedAxes used = used_axes(residual, measured);
  const int best = *std::max_element(chosen.begin(), chosen.end());
  const auto trees = blended_trees(u, used.y, settings, validation.candidates[best]);
  for (std::size_t k = 0; k < used.axis.size(); ++k)
    if (chosen[used.axis[k]] > 0) out.trees[used.axis[k]] = trees[k];
}

void grow_chosen(const Samples& q, const Samples& residual, const Validation& validation,
                 const Chosen& chosen, const TreeSettings& settings, TreeChoice& out) {
  const Samples u = normalised(out.domain, q);
  const bool blended = settings.form == TreeForm::kBlended;
  if (blended && settings.sharing == Sharing::kShared)
    grow_shared(u, residual, validation, chosen, settings, out);
  else
    run_jobs(format::kTreeAxes, [&](int axis) {
      const TreeCandidate& candidate = validation.candidates[chosen[axis]];
      if (candidate.leaves == 0) return;
      out.trees[axis] = blended ? blended_trees(u, residual.col(axis), settings, candidate)[0]
                                : crisp_tree(u, residual.col(axis), settings, candidate);
    });
  for (int axis = 0; axis < format::kTreeAxes; ++axis) {
    out.leaves[axis] = static_cast<int>(out.trees[axis].leaves());
    if (out.leaves[axis] > 0 && blended)
      add_sigma(u, validation.error[axis].col(chosen[axis]), out.trees[axis]);
  }
}

/// The order in which rows are used, which depends on the data only. Sums depend on the order of
/// their terms in the last bit.
std::vector<int> lexicographic_pairs(const Samples& q, const Samples& residual) {
  Samples table(q.rows(), q.cols() + residual.cols());
  table << q, residual;
  return lexicographic(table);
}

/// The largest degree of the leaves for which there are enough poses.
int degree_for(const TreeSettings& settings, int poses, int joints) {
  if (settings.form == TreeForm::kCrisp) return 1;
  const auto terms = static_cast<int>(format::leaf_terms(joints, 2));
  return poses < kPosesPerCoefficient * terms ? 1 : settings.max_degree;
}

TreeChoice choose_form(const Samples& all_q, const Samples& all_residual,
                       const std::array<bool, 3>& axis_used, std::span<const int> all_groups,
                       const TreeSettings& settings) {
  const auto order = lexicographic_pairs(all_q, all_residual);
  const Samples q = rows_of(all_q, order), residual = rows_of(all_residual, order);
  std::vector<int> group;
  for (int row : order) group.push_back(all_groups[row]);
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
  const FoldedSamples samples{q, residual, axis_used, fold, settings.folds};
  const GrowthSettings growth = growth_of(settings, degree_for(settings, poses, joints));
  const bool crisp = settings.form == TreeForm::kCrisp;
  const Sharing sharing = crisp ? Sharing::kOwn : settings.sharing;
  const Validation validation =
      crisp ? validate_crisp(samples, growth) : validate_blended(samples, growth, sharing);
  const double asked = asked_gain(settings.min_gain, poses, joints);
  const Chosen chosen =
      convincing(validation, best_of(validation, sharing, static_cast<int>(q.cols())), asked);
  const Eigen::VectorXd before = squared_error_of(validation, Chosen{});
  const Eigen::VectorXd after = squared_error_of(validation, chosen);
  const Gain gain = gain_of(before, after, validation.rows, asked);
  out.cv_before_m = gain.before;
  out.cv_after_m = gain.convinces() ? gain.after : gain.before;
  out.gain_se_m = gain.se;
  out.reason = why(gain, words_for(validation, chosen, settings.form), chosen != Chosen{}, asked);
  if (gain.convinces()) grow_chosen(q, residual, validation, chosen, settings, out);
  return out;
}

}  // namespace

TreeChoice choose_trees(const Samples& q, const Samples& residual,
                        const std::array<bool, 3>& axis_used, std::span<const int> group,
                        const TreeSettings& settings) {
  if (settings.form != TreeForm::kEither)
    return choose_form(q, residual, axis_used, group, settings);
  TreeSettings one = settings;
  one.form = TreeForm::kBlended;
  TreeChoice blended = choose_form(q, residual, axis_used, group, one);
  one.form = TreeForm::kCrisp;
  TreeChoice crisp = choose_form(q, residual, axis_used, group, one);
  return crisp.cv_after_m < kCrispMustGain * blended.cv_after_m ? crisp : blended;
}

}  // namespace plumb::offline
