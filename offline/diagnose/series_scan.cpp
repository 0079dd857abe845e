// SPDX-License-Identifier: Apache-2.0
#include "diagnose/series_scan.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "diagnose/constants.hpp"
#include "diagnose/few_digits.hpp"
#include "diagnose/series_prior.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

constexpr int kMostTurns = 4;
constexpr double kSettledShare = 1e-3;

EffectEntry series_entry(std::vector<int> joints) {
  return {.name = series_effect(), .joints = std::move(joints), .options = {}, .place = {}};
}

/// The joint that the series can best do without, and how much evidence it adds.
std::pair<int, double> weakest(const SeriesPriorSearch& search, const SeriesEvidence& all) {
  std::pair<int, double> out{-1, std::numeric_limits<double>::infinity()};
  const double with = search.evidence_with(all.prior).ln_bayes;
  for (const int joint : search.joints()) {
    std::vector<int> others = search.joints();
    std::erase(others, joint);
    const double without =
        others.empty() ? 0.0 : search.of(others).evidence_with(all.prior).ln_bayes;
    if (with - without < out.second) out = {joint, with - without};
  }
  return out;
}

/// The standard deviation of each wave of the entry's prior [rad], for one joint after the other.
Eigen::VectorXd prior_sigma(const EffectEntry& entry) {
  const double slope = number_option(entry, OptionKey::kSlope, 0.0);
  const double size = number_option(entry, OptionKey::kSize_urad, 1.0) * 1e-6;
  const auto count = 2 * static_cast<Eigen::Index>(number_option(entry, OptionKey::kWaves, 1.0));
  Eigen::VectorXd out(count * static_cast<Eigen::Index>(entry.joints.size()));
  for (Eigen::Index c = 0; c < out.size(); ++c)
    out(c) = size * std::pow(1.0 + static_cast<double>(c % count / 2), -slope);
  return out;
}

void set_prior(EffectEntry& entry, const SeriesEvidence& best) {
  set_option(entry, OptionKey::kSize_urad, three_digits(1e6 * best.prior.ratio * best.scatter));
  set_option(entry, OptionKey::kSlope, std::round(100.0 * best.prior.slope) / 100.0);
}

Products scaled(Products p, const Eigen::VectorXd& by) {
  p.XX = (by.asDiagonal() * p.XX * by.asDiagonal()).eval();
  p.UX = (p.UX * by.asDiagonal()).eval();
  p.Xy = p.Xy.cwiseProduct(by);
  return p;
}

}  // namespace

Regressor series_regressor(const WhitenedFit& s, const EffectEntry& entry) {
  Regressor out;
  out.entry = entry;
  out.joints = entry.joints;
  out.typical = prior_sigma(entry);
  out.columns.resize(s.poses(), out.typical.size());
  const Eigen::Index count = out.typical.size() / static_cast<Eigen::Index>(entry.joints.size());
  for (std::size_t i = 0; i < entry.joints.size(); ++i)
    out.columns.middleCols(static_cast<Eigen::Index>(i) * count, count) =
        waves_of_joint(s, entry.joints[i], static_cast<int>(count));
  out.columns *= out.typical.asDiagonal();
  out.members.resize(static_cast<std::size_t>(out.typical.size()));
  std::iota(out.members.begin(), out.members.end(), 0);
  return out;
}

Eigen::MatrixXd series_motions(const WhitenedFit& s, const Regressor& series) {
  const Eigen::Index each = series.columns.cols() / static_cast<Eigen::Index>(series.joints.size());
  Eigen::MatrixXd out(s.poses() * s.axes, series.columns.cols());
  for (Eigen::Index c = 0; c < out.cols(); ++c) {
    const Eigen::VectorXd& joint = s.joint[series.joints[static_cast<std::size_t>(c / each)]];
    for (Eigen::Index i = 0; i < out.rows(); ++i)
      out(i, c) = series.columns(i / s.axes, c) * joint(i);
  }
  return out;
}

Eigen::VectorXd motion(const WhitenedFit& s, const Regressor& regressor,
                       const Eigen::VectorXd& theta) {
  if (regressor.joints.empty() && regressor.joint < 0) return regressor.columns * theta;
  const std::vector<int> joints =
      regressor.joints.empty() ? std::vector<int>{regressor.joint} : regressor.joints;
  const Eigen::Index each = theta.size() / static_cast<Eigen::Index>(joints.size());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(s.poses() * s.axes);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto first = static_cast<Eigen::Index>(j) * each;
    const Eigen::VectorXd turn =
        regressor.columns.middleCols(first, each) * theta.segment(first, each);
    for (Eigen::Index i = 0; i < out.size(); ++i)
      out(i) += turn(i / s.axes) * s.joint[joints[j]](i);
  }
  return out;
}

Regressor smooth_part(const WhitenedFit& s, const Regressor& series) {
  const auto joints = static_cast<Eigen::Index>(series.joints.size());
  const Eigen::Index each = series.columns.cols() / joints;
  const Eigen::Index kept = std::min(each, 2 * kSmoothWaves);
  Regressor some = series;
  some.columns.resize(s.poses(), joints * kept);
  for (Eigen::Index j = 0; j < joints; ++j)
    some.columns.middleCols(j * kept, kept) = series.columns.middleCols(j * each, kept);
  Regressor out;
  out.entry = series.entry;
  out.columns = motions(s, some);
  return out;
}

RegressorScore score_series(const Scorer& scorer, const EffectEntry& entry,
                            const SeriesProducts& products) {
  const WhitenedFit& s = scorer.whitened();
  const Eigen::VectorXd typical = prior_sigma(entry);
  RegressorScore out;
  for (const Products& fold : products.folds) out.folds.push_back(scaled(fold, typical));
  const Products all = scaled(products.all, typical);
  const Eigen::MatrixXd gram = all.XX - all.UX.transpose() * all.UX;
  for (Eigen::Index c = 0; c < all.Xy.size(); ++c) out.active.push_back(c);
  const EvidenceScale scale = scorer.scale();
  // The scatter that is left decides how much the prior weighs, and that how much is left.
  double left = s.Q / scale.lines;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    Eigen::MatrixXd held = gram;
    held.diagonal().array() += left;
    const Eigen::LLT<Eigen::MatrixXd> llt(held);
    out.theta = llt.solve(all.Xy);
    const double before = scale.dof * scale.variance + s.Q;
    const double after = std::max(1e-12 * before, before - all.Xy.dot(out.theta));
    const double n = scale.lines + scale.dof;
    const double paid = llt.matrixLLT().diagonal().array().log().sum() -
                        0.5 * static_cast<double>(all.Xy.size()) * std::log(left);
    out.evidence = {-paid - 0.5 * n * std::log(after / before), 1.0};
    const bool settled = std::abs(after / n - left) < kSettledShare * left;
    left = after / n;
    if (settled) break;
  }
  out.variance = left;
  out.evidence.ln_bayes -= s.scatter_nats;
  const double seen = out.theta.dot(gram * out.theta), moved = out.theta.dot(all.XX * out.theta);
  out.explained = s.Q > 0.0 ? (2.0 * out.theta.dot(all.Xy) - seen) / s.Q : 0.0;
  out.absorbed = moved > 0.0 ? std::clamp(1.0 - seen / moved, 0.0, 1.0) : 0.0;
  return out;
}

RegressorScore score_series(const Scorer& scorer, const EffectEntry& entry) {
  SeriesSums sums(scorer.whitened(),
                  static_cast<int>(number_option(entry, OptionKey::kWaves, 1.0)));
  return score_series(scorer, entry, sums.of(entry.joints));
}

std::optional<SeriesFound> scan_series(const Scorer& scorer, SeriesSums& sums,
                                       const std::vector<int>& joints) {
  if (joints.empty()) return std::nullopt;
  SeriesPriorSearch search(scorer, sums.of(joints));
  SeriesEvidence best = search.best_prior();
  for (;;) {
    const auto [joint, adds] = weakest(search, best);
    if (adds > kSupported) break;
    std::vector<int> others = search.joints();
    std::erase(others, joint);
    if (others.empty()) return std::nullopt;
    search = search.of(others);
    best = search.best_prior();
  }
  SeriesFound out{series_entry(search.joints()), {}};
  set_option(out.entry, OptionKey::kWaves, static_cast<double>(kSeriesWaves));
  set_prior(out.entry, best);
  out.scored = score_series(scorer, out.entry, search.products());
  out.scored.evidence.ln_bayes = best.ln_bayes - scorer.whitened().scatter_nats;
  return out;
}

EffectEntry with_narrowest_prior(const Scorer& scorer, EffectEntry entry) {
  SeriesSums sums(scorer.whitened(),
                  static_cast<int>(number_option(entry, OptionKey::kWaves, 1.0)));
  const SeriesPriorSearch search(scorer, sums.of(entry.joints));
  set_prior(entry, search.narrowest_prior(search.best_prior()));
  return entry;
}

}  // namespace plumb::offline
