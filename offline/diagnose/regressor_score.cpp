// SPDX-License-Identifier: Apache-2.0
#include "diagnose/regressor_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/constants.hpp"
#include "diagnose/evidence_scale.hpp"
#include "numbers/gaussian.hpp"
#include "numbers/products.hpp"

namespace plumb::offline {
namespace {

constexpr double kLeastVariance = 1e-12;  // noise-free data
constexpr double kRidge = 1e-9;           // a parameter may be observable in one fold alone

Products products_of_joint(const WhitenedFit& s, const Regressor& regressor, const Segment& at) {
  const auto S = regressor.columns.middleRows(at.begin, at.size());
  const auto square = s.joint_square[regressor.joint].segment(at.begin, at.size());
  Products out;
  const Eigen::MatrixXd weighed = square.asDiagonal() * S;
  out.XX = symmetric_product(S, weighed);
  out.UX = transposed_product(s.joint_U[regressor.joint].middleRows(at.begin, at.size()), S);
  out.Xy = S.transpose() * s.joint_y[regressor.joint].segment(at.begin, at.size());
  return out;
}

Products products_of_motions(const WhitenedFit& s, const Regressor& regressor, const Segment& at) {
  const Eigen::Index first = s.table.begin(at.begin), count = s.table.count(at.begin, at.end);
  const auto X = regressor.columns.middleRows(first, count);
  Products out;
  out.XX = gram_matrix(X);
  out.UX = transposed_product(s.U.middleRows(first, count), X);
  out.Xy = X.transpose() * s.y.segment(first, count);
  return out;
}

Products active_of(const Products& all, const std::vector<Eigen::Index>& active) {
  return {all.XX(active, active), all.UX(Eigen::all, active), all.Xy(active)};
}

}  // namespace

Products sum_of(const std::vector<Products>& all) {
  Products out = all.front();
  for (std::size_t f = 1; f < all.size(); ++f) {
    out.XX += all[f].XX;
    out.UX += all[f].UX;
    out.Xy += all[f].Xy;
  }
  return out;
}

double times_noise(const WhitenedFit& whitened) {
  if (!whitened.noise.known) return 1.0;
  const auto free =
      static_cast<double>(std::max<Eigen::Index>(1, whitened.fit_lines - whitened.rank));
  return whitened.Q / free / whitened.noise.variance;
}

double at_noise(const WhitenedFit& whitened) {
  return kAtNoise + 2.0 * std::sqrt(2.0 / std::max(1.0, whitened.noise.dof));
}

bool reaches_noise(const WhitenedFit& whitened, const RegressorScore& scored) {
  const double before = times_noise(whitened);
  return before > kAboveNoise && scored.explained > kNearlyAll &&
         before * (1.0 - scored.explained) < at_noise(whitened);
}

EvidenceScale evidence_scale(const WhitenedFit& whitened) {
  EvidenceScale out;
  out.lines = static_cast<double>(std::max<Eigen::Index>(1, whitened.fit_lines - whitened.rank));
  out.variance = whitened.noise.known ? whitened.noise.variance : whitened.Q / out.lines;
  out.variance = std::max(out.variance, 1e-12);
  out.dof = whitened.noise.known ? whitened.noise.dof : 0.0;
  return out;
}

Scorer::Scorer(const WhitenedFit& whitened)
    : whitened_(whitened), scale_(evidence_scale(whitened)) {
  const Eigen::Index p = whitened.rank;
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(p, p);
  for (const auto& at : whitened.folds) {
    const auto U = whitened.U.middleRows(whitened.table.begin(at.begin),
                                         whitened.table.count(at.begin, at.end));
    const auto y =
        whitened.y.segment(whitened.table.begin(at.begin), whitened.table.count(at.begin, at.end));
    Fold fold;
    fold.UU = gram_matrix(U);
    fold.Uy = U.transpose() * y;
    fold.yy = y.squaredNorm();
    fold.without = Cholesky(I * (1.0 + kRidge) - fold.UU).solve(I);
    const Eigen::VectorXd a = -(fold.without * fold.Uy);
    fold.error = fold.yy - 2.0 * a.dot(fold.Uy) + a.dot(fold.UU * a);
    folds_.push_back(std::move(fold));
  }
}

/// The column that violates its sign constraint most, or -1.
static Eigen::Index most_negative(const Regressor& regressor,
                                  const std::vector<Eigen::Index>& active,
                                  const Eigen::VectorXd& theta) {
  Eigen::Index worst = -1;
  for (std::size_t i = 0; i < active.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (regressor.positive.empty() || !regressor.positive[active[i]] || theta(at) >= 0.0) continue;
    if (worst < 0 || theta(at) < theta(worst)) worst = at;
  }
  return worst;
}

namespace {

/// What other arms of the model say for or against an effect in this one [nats].
double sister_odds(const Cell& cell, const std::string& effect) {
  for (const auto& one : cell.fit.sister_odds)
    if (one.effect == effect) return one.nats;
  return 0.0;
}

}  // namespace

RegressorScore Scorer::score(const Regressor& regressor) const {
  RegressorScore out;
  out.folds = products_by_fold(regressor);
  const Products all = sum_of(out.folds);
  const Eigen::MatrixXd whole = all.XX - all.UX.transpose() * all.UX;
  for (Eigen::Index c = 0; c < all.Xy.size(); ++c) out.active.push_back(c);
  out.theta.setZero(all.Xy.size());
  while (!out.active.empty()) {
    const Eigen::MatrixXd gram = whole(out.active, out.active);
    const Eigen::VectorXd v = all.Xy(out.active);
    out.evidence = evidence(gram, v, whitened_.Q, scale_);
    if (out.evidence.ln_bayes <= kImpossible) out.active.clear();
    if (out.active.empty()) break;
    out.variance = variance_with(gram, v, out.evidence.width);
    const Eigen::VectorXd theta =
        SymmetricSolver(with_prior(gram, out.evidence.width, out.variance)).solve(v);
    const Eigen::Index worst = most_negative(regressor, out.active, theta);
    if (worst < 0) {
      out.theta(out.active) = theta;
      break;
    }
    out.active.erase(out.active.begin() + worst);
  }
  // Columns held at 0 because of their sign were tried too: each costs ln 2.
  out.evidence.ln_bayes -=
      std::log(2.0) *
      static_cast<double>(all.Xy.size() - static_cast<Eigen::Index>(out.active.size()));
  out.evidence.ln_bayes -= whitened_.scatter_nats;
  out.evidence.ln_bayes += sister_odds(*whitened_.cell, regressor.entry.name);
  if (out.active.empty()) out.evidence.ln_bayes = kImpossible;
  const double seen = out.theta.dot(whole * out.theta), moved = out.theta.dot(all.XX * out.theta);
  out.explained = whitened_.Q > 0.0 ? (2.0 * out.theta.dot(all.Xy) - seen) / whitened_.Q : 0.0;
  out.absorbed = moved > 0.0 ? std::clamp(1.0 - seen / moved, 0.0, 1.0) : 0.0;
  return out;
}

/// Posterior mean of the variance of a line, from the known noise and from the residual that the
/// regressor leaves.
double Scorer::variance_with(const Eigen::MatrixXd& gram, const Eigen::VectorXd& v,
                             double width) const {
  const SymmetricSolver solver(with_prior(gram, width, scale_.variance));
  const double left = std::max(0.0, whitened_.Q - v.dot(solver.solve(v)));
  return std::max(kLeastVariance, (scale_.dof * scale_.variance + left) /
                                      (scale_.dof + std::max(1.0, scale_.lines)));
}

Products Scorer::products(const Regressor& regressor) const {
  const Segment all{0, whitened_.fit_poses()};
  return regressor.joint >= 0 ? products_of_joint(whitened_, regressor, all)
                              : products_of_motions(whitened_, regressor, all);
}

Scorer::Without Scorer::without(std::size_t f) const {
  return {-(folds_[f].without * folds_[f].Uy), {}};
}

Scorer::Without Scorer::without(std::size_t f, const RegressorScore& scored) const {
  const Products all = active_of(sum_of(scored.folds), scored.active);
  const Products held = active_of(scored.folds[f], scored.active);
  const Fold& fold = folds_[f];
  const Eigen::MatrixXd B = all.UX - held.UX;
  const Eigen::MatrixXd AB = fold.without * B;
  const Eigen::MatrixXd S = with_prior(all.XX - held.XX - (B.transpose() * AB).eval(),
                                       scored.evidence.width, scored.variance);
  const Eigen::VectorXd theta =
      SymmetricSolver(S).solve(all.Xy - held.Xy + AB.transpose() * fold.Uy);
  Without out{-(fold.without * fold.Uy) - AB * theta, Eigen::VectorXd::Zero(scored.theta.size())};
  out.regressor(scored.active) = theta;
  return out;
}

/// Sum of squares of one fold, as the others predict it with the regressor.
double Scorer::held_out_with(std::size_t f, const RegressorScore& scored) const {
  const Fold& fold = folds_[f];
  if (scored.theta.size() == 0) return fold.error;
  const Products& held = scored.folds[f];
  const auto [a, theta] = without(f, scored);
  return fold.yy - 2.0 * (a.dot(fold.Uy) + theta.dot(held.Xy)) + a.dot(fold.UU * a) +
         2.0 * a.dot(held.UX * theta) + theta.dot(held.XX * theta);
}

Gain Scorer::gain(const RegressorScore& scored) const {
  std::vector<double> before, after;
  for (std::size_t f = 0; f < folds_.size(); ++f) {
    before.push_back(folds_[f].error);
    after.push_back(held_out_with(f, scored));
  }
  return gain_of(before, after);
}

Gain Scorer::gain(const std::vector<RegressorScore>& by_fold) const {
  std::vector<double> before, after;
  for (std::size_t f = 0; f < folds_.size(); ++f) {
    before.push_back(folds_[f].error);
    after.push_back(held_out_with(f, by_fold[f]));
  }
  return gain_of(before, after);
}

std::vector<Products> Scorer::products_by_fold(const Regressor& regressor) const {
  std::vector<Products> out;
  for (const auto& at : whitened_.folds)
    out.push_back(regressor.joint >= 0 ? products_of_joint(whitened_, regressor, at)
                                       : products_of_motions(whitened_, regressor, at));
  return out;
}

Scorer::Cleared Scorer::cleared_without(std::size_t f, const std::vector<Products>& by_fold) const {
  const Fold& fold = folds_[f];
  const Products all = sum_of(by_fold);
  const Eigen::MatrixXd UX = all.UX - by_fold[f].UX;
  // Over all folds the residual is orthogonal to the model.
  const Eigen::VectorXd Uy = -fold.Uy;
  const Eigen::MatrixXd AUX = fold.without * UX;
  Cleared out;
  out.XX = all.XX - by_fold[f].XX - UX.transpose() * AUX;
  out.Xy = all.Xy - by_fold[f].Xy - AUX.transpose() * Uy;
  out.Q = whitened_.Q - fold.yy - Uy.dot(fold.without * Uy);
  out.scale = scale_;
  out.scale.lines =
      std::max(1.0, scale_.lines - static_cast<double>(whitened_.table.count(
                                       whitened_.folds[f].begin, whitened_.folds[f].end)));
  return out;
}

Gain gain_of(const std::vector<double>& before, const std::vector<double>& after) {
  double all_before = 0.0, all_after = 0.0, sum = 0.0, squares = 0.0;
  double share = 0.0, share_squares = 0.0;  // of the folds' RMS
  for (std::size_t f = 0; f < before.size(); ++f) {
    const double better = before[f] - after[f];
    all_before += before[f];
    all_after += after[f];
    sum += better;
    squares += better * better;
    const double fall = 1.0 - std::sqrt(std::max(0.0, after[f]) / std::max(before[f], 1e-300));
    share += fall;
    share_squares += fall * fall;
  }
  const auto K = static_cast<double>(before.size());
  const double mean = sum / K;
  const double se = std::sqrt(std::max(0.0, squares / K - mean * mean) / std::max(1.0, K - 1.0));
  Gain out;
  if (all_before <= 0.0) return out;
  out.share = 1.0 - std::sqrt(std::max(0.0, all_after) / all_before);
  // The folds share most of the poses that they are fitted to, and so are less independent than
  // they look: the variance of their mean is not 1 / K but 1 / K + 1 / (K - 1) of the spread
  // [Nadeau & Bengio 2003].
  const double spread =
      std::max(0.0, share_squares / K - share / K * share / K) * K / std::max(1.0, K - 1.0);
  out.share_se = std::sqrt(spread * (1.0 / K + 1.0 / std::max(1.0, K - 1.0)));
  out.standard_errors = mean / std::max(se, std::numeric_limits<double>::min());
  out.clear = out.share > kClearShare && mean > se;
  return out;
}

}  // namespace plumb::offline
