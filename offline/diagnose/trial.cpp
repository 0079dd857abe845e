// SPDX-License-Identifier: Apache-2.0
#include "diagnose/trial.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace plumb::offline {
namespace {

constexpr double kClearShare = 0.01;
constexpr double kAtNoise = 1.15;    // times the noise's mean square
constexpr double kNearlyAll = 0.75;  // of what is left
constexpr double kRidge = 1e-9;      // a fold may be all that says something about a parameter

Products products_of_joint(const Stage& s, const Block& block, const Segment& at) {
  const auto S = block.columns.middleRows(at.begin, at.size());
  const auto square = s.joint_square[block.joint].segment(at.begin, at.size());
  Products out;
  const Eigen::MatrixXd weighed = square.asDiagonal() * S;
  out.XX = S.transpose() * weighed;
  out.UX = s.joint_U[block.joint].middleRows(at.begin, at.size()).transpose() * S;
  out.Xy = S.transpose() * s.joint_y[block.joint].segment(at.begin, at.size());
  return out;
}

Products products_of_motions(const Stage& s, const Block& block, const Segment& at) {
  const Eigen::Index first = at.begin * s.axes, count = at.size() * s.axes;
  const auto X = block.columns.middleRows(first, count);
  Products out;
  out.XX = X.transpose() * X;
  out.UX = s.U.middleRows(first, count).transpose() * X;
  out.Xy = X.transpose() * s.y.segment(first, count);
  return out;
}

Products sum_of(const std::vector<Products>& all) {
  Products out = all.front();
  for (std::size_t f = 1; f < all.size(); ++f) {
    out.XX += all[f].XX;
    out.UX += all[f].UX;
    out.Xy += all[f].Xy;
  }
  return out;
}

Products active_of(const Products& all, const std::vector<Eigen::Index>& active) {
  return {all.XX(active, active), all.UX(Eigen::all, active), all.Xy(active)};
}

}  // namespace

Eigen::MatrixXd motions(const Stage& s, const Block& block) {
  if (block.joint < 0) return block.columns;
  Eigen::MatrixXd out(s.poses() * s.axes, block.columns.cols());
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    out.row(i) = block.columns.row(i / s.axes) * s.joint[block.joint](i);
  return out;
}

double times_noise(const Stage& stage) {
  if (!stage.noise.known) return 1.0;
  const auto free = static_cast<double>(std::max<Eigen::Index>(1, stage.fit_lines - stage.rank));
  return stage.Q / free / stage.noise.variance;
}

double at_noise(const Stage& stage) {
  return kAtNoise + 2.0 * std::sqrt(2.0 / std::max(1.0, stage.noise.dof));
}

bool reaches_noise(const Stage& stage, const Trial& trial) {
  const double before = times_noise(stage);
  return before > kAboveNoise && trial.explained > kNearlyAll &&
         before * (1.0 - trial.explained) < at_noise(stage);
}

Judge::Judge(const Stage& stage) : stage_(stage) {
  const Eigen::Index p = stage.rank;
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(p, p);
  scale_.lines = static_cast<double>(std::max<Eigen::Index>(1, stage.fit_lines - p));
  scale_.variance = stage.noise.known ? stage.noise.variance : stage.Q / scale_.lines;
  scale_.variance = std::max(scale_.variance, 1e-12);
  scale_.dof = stage.noise.known ? stage.noise.dof : 0.0;
  for (const auto& at : stage.folds) {
    const auto U = stage.U.middleRows(at.begin * stage.axes, at.size() * stage.axes);
    const auto y = stage.y.segment(at.begin * stage.axes, at.size() * stage.axes);
    Fold fold;
    fold.UU = U.transpose() * U;
    fold.Uy = U.transpose() * y;
    fold.yy = y.squaredNorm();
    fold.without = (I * (1.0 + kRidge) - fold.UU).llt().solve(I);
    const Eigen::VectorXd a = -(fold.without * fold.Uy);
    fold.error = fold.yy - 2.0 * a.dot(fold.Uy) + a.dot(fold.UU * a);
    folds_.push_back(std::move(fold));
  }
}

/// The column that its sign forbids most, or -1.
static Eigen::Index most_negative(const Block& block, const std::vector<Eigen::Index>& active,
                                  const Eigen::VectorXd& theta) {
  Eigen::Index worst = -1;
  for (std::size_t i = 0; i < active.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (block.positive.empty() || !block.positive[active[i]] || theta(at) >= 0.0) continue;
    if (worst < 0 || theta(at) < theta(worst)) worst = at;
  }
  return worst;
}

Trial Judge::judge(const Block& block) const {
  Trial out;
  for (const auto& at : stage_.folds)
    out.folds.push_back(block.joint >= 0 ? products_of_joint(stage_, block, at)
                                         : products_of_motions(stage_, block, at));
  const Products all = sum_of(out.folds);
  const Eigen::MatrixXd whole = all.XX - all.UX.transpose() * all.UX;
  for (Eigen::Index c = 0; c < all.Xy.size(); ++c) out.active.push_back(c);
  out.theta.setZero(all.Xy.size());
  while (!out.active.empty()) {
    const Eigen::MatrixXd gram = whole(out.active, out.active);
    const Eigen::VectorXd v = all.Xy(out.active);
    out.evidence = evidence(gram, v, stage_.Q, scale_);
    if (out.evidence.ln_bayes <= kImpossible) out.active.clear();
    if (out.active.empty()) break;
    const double ridge = scale_.variance / std::pow(out.evidence.width, 2);
    const Eigen::VectorXd theta =
        (gram + ridge * Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).ldlt().solve(v);
    const Eigen::Index worst = most_negative(block, out.active, theta);
    if (worst < 0) {
      out.theta(out.active) = theta;
      break;
    }
    out.active.erase(out.active.begin() + worst);
  }
  // What its sign holds at 0 was tried as well.
  out.evidence.ln_bayes -=
      std::log(2.0) *
      static_cast<double>(all.Xy.size() - static_cast<Eigen::Index>(out.active.size()));
  if (out.active.empty()) out.evidence.ln_bayes = kImpossible;
  const double seen = out.theta.dot(whole * out.theta), moved = out.theta.dot(all.XX * out.theta);
  out.explained = stage_.Q > 0.0 ? (2.0 * out.theta.dot(all.Xy) - seen) / stage_.Q : 0.0;
  out.absorbed = moved > 0.0 ? std::clamp(1.0 - seen / moved, 0.0, 1.0) : 0.0;
  return out;
}

Products Judge::products(const Block& block) const {
  const Segment all{0, stage_.fit_poses()};
  return block.joint >= 0 ? products_of_joint(stage_, block, all)
                          : products_of_motions(stage_, block, all);
}

Judge::Without Judge::without(std::size_t f) const {
  return {-(folds_[f].without * folds_[f].Uy), {}};
}

Judge::Without Judge::without(std::size_t f, const Trial& trial) const {
  const Products all = active_of(sum_of(trial.folds), trial.active);
  const Products held = active_of(trial.folds[f], trial.active);
  const double left = std::max(scale_.variance, stage_.Q * (1.0 - trial.explained) / scale_.lines);
  const double ridge = left / std::pow(trial.evidence.width, 2);
  const Eigen::Index b = all.Xy.size();
  const Fold& fold = folds_[f];
  const Eigen::MatrixXd B = all.UX - held.UX;
  const Eigen::MatrixXd AB = fold.without * B;
  const Eigen::MatrixXd S =
      all.XX - held.XX - B.transpose() * AB + ridge * Eigen::MatrixXd::Identity(b, b);
  const Eigen::VectorXd theta = S.ldlt().solve(all.Xy - held.Xy + AB.transpose() * fold.Uy);
  Without out{-(fold.without * fold.Uy) - AB * theta, Eigen::VectorXd::Zero(trial.theta.size())};
  out.block(trial.active) = theta;
  return out;
}

Gain Judge::gain(const Trial& trial) const {
  double before = 0.0, after = 0.0, sum = 0.0, squares = 0.0;
  double share = 0.0, share_squares = 0.0;  // of the folds' RMS
  for (std::size_t f = 0; f < folds_.size(); ++f) {
    const Fold& fold = folds_[f];
    const Products& held = trial.folds[f];
    const auto [a, theta] = without(f, trial);
    const double error = fold.yy - 2.0 * (a.dot(fold.Uy) + theta.dot(held.Xy)) +
                         a.dot(fold.UU * a) + 2.0 * a.dot(held.UX * theta) +
                         theta.dot(held.XX * theta);
    const double better = fold.error - error;
    before += fold.error;
    after += error;
    sum += better;
    squares += better * better;
    const double fall = 1.0 - std::sqrt(std::max(0.0, error) / std::max(fold.error, 1e-300));
    share += fall;
    share_squares += fall * fall;
  }
  const auto K = static_cast<double>(folds_.size());
  const double mean = sum / K;
  const double se = std::sqrt(std::max(0.0, squares / K - mean * mean) / std::max(1.0, K - 1.0));
  Gain out;
  if (before <= 0.0) return out;
  out.share = 1.0 - std::sqrt(std::max(0.0, after) / before);
  const double spread = std::max(0.0, share_squares / K - share / K * share / K);
  out.share_se = std::sqrt(spread / std::max(1.0, K - 1.0));
  out.clear = out.share > kClearShare && mean > se;
  return out;
}

}  // namespace plumb::offline
