// SPDX-License-Identifier: Apache-2.0
#include "diagnose/series_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "arm/effect_binding.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/few_digits.hpp"
#include "effects/registry.hpp"
#include "numbers/gaussian.hpp"
#include "numbers/products.hpp"
#include "solve/series_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr std::array kSlopes = {0.0, 0.5, 1.0, 1.5};
/// Prior over scatter of one reading at 1 m: half a decade apart.
constexpr std::array kSizes = {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0};
constexpr double kFirstStep = 1.7;
constexpr double kMostSlope = 4.0;          // that a cell can state
constexpr double kFinestFactorOfAll = 1.2;  // hundreds of waves determine a prior no better
constexpr double kMostOfSizes = 0.8;  // of the mean square of all joints: the others have less

EffectEntry series_entry(std::vector<int> joints) {
  return {.name = series_effect(), .joints = std::move(joints), .options = {}, .place = {}};
}

/// Angles of a joint at all poses.
Eigen::VectorXd angles(const WhitenedFit& s, int joint) {
  Eigen::VectorXd out(s.poses());
  for (Eigen::Index i = 0; i < s.poses(); ++i) out(i) = s.q(i)[joint];
  return out;
}

/// Waves of several joints, per radian: shape (poses, joints * count).
Eigen::MatrixXd waves_of(const WhitenedFit& s, const std::vector<int>& joints, int count) {
  Eigen::MatrixXd out(s.poses(), static_cast<Eigen::Index>(joints.size()) * count);
  for (std::size_t i = 0; i < joints.size(); ++i)
    out.middleCols(static_cast<Eigen::Index>(i) * count, count) =
        series_waves(angles(s, joints[i]), count);
  return out;
}

/// Sum over the lines of a pose of the motions of two joints.
Eigen::VectorXd both_by_pose(const WhitenedFit& s, int a, int b) {
  const Eigen::VectorXd product = s.joint[a].cwiseProduct(s.joint[b]);
  Eigen::VectorXd out(s.poses());
  for (Eigen::Index i = 0; i < out.size(); ++i)
    out(i) = product.segment(s.table.begin(i), s.table.count(i)).sum();
  return out;
}

Products products_of_series(const WhitenedFit& s, const Regressor& series, const Segment& at) {
  const Eigen::Index each = series.columns.cols() / static_cast<Eigen::Index>(series.joints.size());
  Products out;
  out.XX.resize(series.columns.cols(), series.columns.cols());
  out.UX.resize(s.rank, series.columns.cols());
  out.Xy.resize(series.columns.cols());
  const auto block = [&](std::size_t i) {
    return series.columns.block(at.begin, static_cast<Eigen::Index>(i) * each, at.size(), each);
  };
  for (std::size_t i = 0; i < series.joints.size(); ++i) {
    const int joint = series.joints[i];
    const auto first = static_cast<Eigen::Index>(i) * each;
    out.UX.middleCols(first, each) =
        transposed_product(s.joint_U[joint].middleRows(at.begin, at.size()), block(i));
    out.Xy.segment(first, each).noalias() =
        block(i).transpose() * s.joint_y[joint].segment(at.begin, at.size());
    for (std::size_t k = 0; k <= i; ++k) {
      const Eigen::VectorXd both =
          both_by_pose(s, joint, series.joints[k]).segment(at.begin, at.size());
      const Eigen::MatrixXd weighed = both.asDiagonal() * block(i);
      out.XX.block(static_cast<Eigen::Index>(k) * each, first, each, each) =
          k == i ? symmetric_product(block(i), weighed) : transposed_product(block(k), weighed);
    }
  }
  out.XX = Eigen::MatrixXd(out.XX.selfadjointView<Eigen::Upper>());
  return out;
}

/// Sums of all folds, cleared of the model; columns per radian.
struct SeriesSums {
  Eigen::MatrixXd gram = {};
  Eigen::VectorXd v = {};
  double Q = 0.0;
  EvidenceScale scale = {};
  int waves = 0;
  std::vector<int> joints = {};

  SeriesSums of(const std::vector<int>& some) const {
    SeriesSums out{.Q = Q, .scale = scale, .waves = waves, .joints = some};
    std::vector<Eigen::Index> index;
    for (std::size_t i = 0; i < joints.size(); ++i)
      if (std::find(some.begin(), some.end(), joints[i]) != some.end())
        for (Eigen::Index c = 0; c < 2 * waves; ++c)
          index.push_back(static_cast<Eigen::Index>(i) * 2 * waves + c);
    out.gram = gram(index, index);
    out.v = v(index);
    return out;
  }
};

/// The prior of a series: wave k has a standard deviation of ratio k^-slope times the scatter of a
/// whitened coordinate [rad].
struct SeriesPrior {
  double ratio = 1.0, slope = 1.0;
};

Eigen::VectorXd sigmas(const SeriesSums& sums, const SeriesPrior& prior) {
  Eigen::VectorXd out(sums.v.size());
  for (Eigen::Index c = 0; c < out.size(); ++c)
    out(c) =
        prior.ratio * std::pow(1.0 + static_cast<double>(c % (2 * sums.waves) / 2), -prior.slope);
  return out;
}

struct SeriesEvidence {
  SeriesPrior prior;
  double ln_bayes = kImpossible;
  double scatter = 0.0;  // of what is left, whitened
};

/// What waves with a prior of their own for every column add to the evidence, in units of the
/// scatter that is left.
struct SeriesTerms {
  double ln_det = 0.0, explained = 0.0;
};

/// sigma: of the prior of each column. Nothing if the equations cannot be solved.
std::optional<SeriesTerms> terms_of(const Eigen::MatrixXd& gram, const Eigen::VectorXd& moments,
                                    const Eigen::VectorXd& sigma) {
  const Cholesky llt(with_prior(sigma.asDiagonal() * gram * sigma.asDiagonal()));
  if (!llt.exists()) return std::nullopt;
  const Eigen::VectorXd v = sigma.cwiseProduct(moments);
  return SeriesTerms{llt.ln_det(), v.dot(llt.solve(v))};
}

SeriesEvidence evidence_of(const SeriesSums& sums, const SeriesPrior& prior,
                           const std::optional<SeriesTerms>& terms) {
  if (!terms) return {prior};
  const double n = sums.scale.lines + sums.scale.dof;
  const EvidenceGain gain = evidence_gain(
      terms->ln_det, sums.scale.dof * sums.scale.variance + sums.Q, terms->explained, n);
  return {prior, gain.ln_bayes, std::sqrt(gain.after / n)};
}

/// Of all columns, and of some.
SeriesEvidence evidence_with(const SeriesSums& sums, const SeriesPrior& prior) {
  return evidence_of(sums, prior, terms_of(sums.gram, sums.v, sigmas(sums, prior)));
}

SeriesEvidence evidence_with(const SeriesSums& sums, const SeriesPrior& prior,
                             const std::vector<Eigen::Index>& columns) {
  const Eigen::VectorXd sigma = sigmas(sums, prior)(columns);
  return evidence_of(sums, prior, terms_of(sums.gram(columns, columns), sums.v(columns), sigma));
}

/// Whether waves of this size are plausible for a gear. Within a range of the joint without poses
/// only the prior limits the series, so a wide prior must not be chosen for what the series
/// explains elsewhere.
bool is_expected(const SeriesEvidence& e) { return e.prior.ratio * e.scatter <= kLargestWave_rad; }

/// ln of the mean of B over the grid, and the best prior of it.
struct OverGrid {
  SeriesEvidence best;
  double ln_mean = kImpossible;
};

/// evidence_at: of a prior; unit: of its width.
template <class EvidenceAt>
OverGrid over_grid(double unit, const EvidenceAt& evidence_at) {
  std::vector<double> ln;
  OverGrid out;
  for (const double slope : kSlopes)
    for (const double size : kSizes) {
      const SeriesEvidence here = evidence_at(SeriesPrior{unit * size, slope});
      if (!is_expected(here)) continue;
      ln.push_back(here.ln_bayes);
      if (here.ln_bayes > out.best.ln_bayes) out.best = here;
    }
  double sum = 0.0;
  for (const double l : ln) sum += std::exp(l - out.best.ln_bayes);
  out.ln_mean = out.best.ln_bayes + std::log(sum / static_cast<double>(ln.size()));
  return out;
}

OverGrid over_grid(const SeriesSums& sums, double unit) {
  return over_grid(unit, [&](const SeriesPrior& prior) { return evidence_with(sums, prior); });
}

/// Climbs from a prior of the grid, by steps that shrink.
SeriesEvidence refined_prior(const SeriesSums& sums, SeriesEvidence best, double finest) {
  for (double step = kFirstStep; step > finest;) {
    bool better = false;
    const SeriesPrior from = best.prior;
    const double turn = 0.25 * (step - 1.0) / (kFirstStep - 1.0);
    for (const SeriesPrior& next :
         {SeriesPrior{from.ratio * step, from.slope}, SeriesPrior{from.ratio / step, from.slope},
          SeriesPrior{from.ratio, std::min(kMostSlope, from.slope + turn)},
          SeriesPrior{from.ratio, std::max(0.0, from.slope - turn)}}) {
      const SeriesEvidence there = evidence_with(sums, next);
      if (there.ln_bayes <= best.ln_bayes || !is_expected(there)) continue;
      best = there;
      better = true;
    }
    if (!better) step = std::sqrt(step);
  }
  return best;
}

/// RMS whitened motion of a joint per radian: the unit of the width of a prior.
double lever_of(const WhitenedFit& s, const std::vector<int>& joints) {
  double sum = 0.0;
  for (const int joint : joints)
    sum += s.joint[joint].head(s.fit_lines).squaredNorm() / static_cast<double>(s.fit_lines);
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, joints.size())));
}

/// The joint that adds the least evidence to the series, and that evidence.
std::pair<int, double> weakest(const SeriesSums& sums, const SeriesEvidence& all) {
  std::pair<int, double> out{-1, std::numeric_limits<double>::infinity()};
  for (const int joint : sums.joints) {
    std::vector<int> others = sums.joints;
    std::erase(others, joint);
    const double without =
        others.empty() ? 0.0 : evidence_with(sums.of(others), all.prior).ln_bayes;
    if (all.ln_bayes - without < out.second) out = {joint, all.ln_bayes - without};
  }
  return out;
}

/// The best prior of the grid, as if the waves of different joints were independent of each other:
/// cheap, and its evidence a little too large where they are not.
SeriesEvidence best_apart(const SeriesSums& sums, double unit) {
  std::vector<SeriesSums> apart;
  for (const int joint : sums.joints) apart.push_back(sums.of({joint}));
  const auto evidence_at = [&](const SeriesPrior& prior) {
    SeriesTerms all;
    for (const SeriesSums& one : apart) {
      const auto terms = terms_of(one.gram, one.v, sigmas(one, prior));
      if (!terms) return SeriesEvidence{prior};
      all.ln_det += terms->ln_det;
      all.explained += terms->explained;
    }
    return evidence_of(sums, prior, all);
  };
  return over_grid(unit, evidence_at).best;
}

/// The joints whose fast waves, which no smooth law imitates, speak for a series beside all others;
/// none if too few of them do so clearly.
std::vector<int> joints_of_fast_waves(const SeriesSums& sums, const SeriesEvidence& all) {
  std::vector<int> out;
  std::size_t clear = 0;
  const Eigen::Index each = 2 * sums.waves;
  for (std::size_t i = 0; i < sums.joints.size(); ++i) {
    std::vector<Eigen::Index> others;
    for (Eigen::Index c = 0; c < sums.v.size(); ++c)
      if (c / each != static_cast<Eigen::Index>(i) || c % each < 2 * kSmoothWaves)
        others.push_back(c);
    const double adds = all.ln_bayes - evidence_with(sums, all.prior, others).ln_bayes;
    if (adds > 0.0) out.push_back(sums.joints[i]);
    if (adds > kFastWavesPay) ++clear;
  }
  return clear < kFewestJointsOfAll ? std::vector<int>{} : out;
}

SeriesFound found_with(const Scorer& scorer, const SeriesSums& sums, const SeriesEvidence& best,
                       double ln_bayes) {
  SeriesFound out{series_entry(sums.joints), {}};
  set_option(out.entry, OptionKey::kWaves, static_cast<double>(sums.waves));
  set_option(out.entry, OptionKey::kSize_urad, three_digits(1e6 * best.prior.ratio * best.scatter));
  set_option(out.entry, OptionKey::kSlope, std::round(100.0 * best.prior.slope) / 100.0);
  out.scored = score_series(scorer, out.entry);
  out.scored.evidence.ln_bayes = ln_bayes - scorer.whitened().scatter_nats;
  return out;
}

SeriesSums sums_of(const Scorer& scorer, const std::vector<int>& joints, int waves) {
  const WhitenedFit& s = scorer.whitened();
  Regressor plain;
  plain.joints = joints;
  plain.columns = waves_of(s, joints, 2 * waves);
  const Products all = products_of_series(s, plain, {0, s.fit_poses()});
  return {all.XX - all.UX.transpose() * all.UX, all.Xy, s.Q, scorer.scale(), waves, joints};
}

}  // namespace

bool has_series_at(const std::vector<EffectEntry>& effects, int joint) {
  return std::any_of(effects.begin(), effects.end(), [&](const EffectEntry& e) {
    return is_series(e.name) && (e.joints.empty() || std::find(e.joints.begin(), e.joints.end(),
                                                               joint) != e.joints.end());
  });
}

Regressor series_regressor(const WhitenedFit& s, const EffectEntry& entry) {
  const double slope = number_option(entry, OptionKey::kSlope, 0.0);
  const double size = number_option(entry, OptionKey::kSize_urad, 1.0) * 1e-6;
  const int count = 2 * static_cast<int>(number_option(entry, OptionKey::kWaves, 1.0));
  Regressor out;
  out.entry = entry;
  out.joints = entry.joints;
  out.columns = waves_of(s, entry.joints, count);
  out.typical.resize(out.columns.cols());
  for (Eigen::Index c = 0; c < out.typical.size(); ++c) {
    out.typical(c) = size * std::pow(1.0 + static_cast<double>(c % count / 2), -slope);
    out.members.push_back(static_cast<int>(c));
  }
  out.columns *= out.typical.asDiagonal();
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

RegressorScore score_series(const Scorer& scorer, const EffectEntry& entry) {
  const WhitenedFit& s = scorer.whitened();
  const Regressor series = series_regressor(s, entry);
  RegressorScore out;
  Products all;
  for (const auto& at : s.folds) {
    out.folds.push_back(products_of_series(s, series, at));
    const Products& one = out.folds.back();
    if (out.folds.size() == 1) {
      all = one;
      continue;
    }
    all.XX += one.XX;
    all.UX += one.UX;
    all.Xy += one.Xy;
  }
  const Eigen::MatrixXd gram = all.XX - all.UX.transpose() * all.UX;
  for (Eigen::Index c = 0; c < all.Xy.size(); ++c) out.active.push_back(c);
  const EvidenceScale scale = scorer.scale();
  // Fixed-point iteration: the weight of the prior depends on the scatter that is left, and that
  // scatter on the weight.
  double left = s.Q / scale.lines;
  for (int turn = 0; turn < 4; ++turn) {
    const Cholesky llt(with_prior(gram, 1.0, left));
    out.theta = llt.solve(all.Xy);
    const double n = scale.lines + scale.dof;
    const EvidenceGain gain =
        evidence_gain(llt.ln_det() - static_cast<double>(all.Xy.size()) * std::log(left),
                      scale.dof * scale.variance + s.Q, all.Xy.dot(out.theta), n);
    out.evidence = {gain.ln_bayes, 1.0};
    left = gain.after / n;
  }
  out.variance = left;
  out.evidence.ln_bayes -= s.scatter_nats;
  const double seen = out.theta.dot(gram * out.theta), moved = out.theta.dot(all.XX * out.theta);
  out.explained = s.Q > 0.0 ? (2.0 * out.theta.dot(all.Xy) - seen) / s.Q : 0.0;
  out.absorbed = moved > 0.0 ? std::clamp(1.0 - seen / moved, 0.0, 1.0) : 0.0;
  return out;
}

std::optional<SeriesFound> scan_series(const Scorer& scorer, const std::vector<int>& joints) {
  const WhitenedFit& s = scorer.whitened();
  if (joints.empty()) return std::nullopt;
  SeriesSums sums = sums_of(scorer, joints, kSeriesWaves);
  const double unit = 1.0 / lever_of(s, joints);
  OverGrid grid = over_grid(sums, unit);
  for (;;) {
    const auto [joint, adds] = weakest(sums, grid.best);
    if (adds > kSupported) break;
    std::vector<int> others = sums.joints;
    std::erase(others, joint);
    if (others.empty()) return std::nullopt;
    sums = sums.of(others);
    grid = over_grid(sums, unit);
  }
  return found_with(scorer, sums, refined_prior(sums, grid.best, kFinestFactor), grid.ln_mean);
}

std::optional<SeriesFound> scan_series_of_all(const Scorer& scorer, const std::vector<int>& joints,
                                              double paid) {
  const WhitenedFit& s = scorer.whitened();
  if (joints.size() < kFewestJointsOfAll) return std::nullopt;
  // The mean over a grid is at least the largest value divided by the number of its points.
  const double grid = std::log(static_cast<double>(kSlopes.size() * kSizes.size()));
  const double least = kSupported + grid + paid + s.scatter_nats;
  SeriesSums sums = sums_of(scorer, joints, kWavesOfAll);
  const SeriesEvidence apart = best_apart(sums, 1.0 / lever_of(s, joints));
  if (!(apart.ln_bayes > kSupported)) return std::nullopt;
  const auto climbed = [&](const SeriesPrior& from) {
    return refined_prior(sums, evidence_with(sums, from), kFinestFactorOfAll);
  };
  SeriesEvidence best = climbed(apart.prior);
  if (!(best.ln_bayes > kSupported)) return std::nullopt;
  const std::vector<int> some = joints_of_fast_waves(sums, best);
  if (some.empty()) return std::nullopt;
  if (some.size() < joints.size()) {
    sums = sums.of(some);
    best = climbed(best.prior);
  }
  if (!(best.ln_bayes > least)) return std::nullopt;
  return found_with(scorer, sums, best, best.ln_bayes - grid);
}

std::string sizes_of(const WhitenedFit& s, const EffectEntry& entry, const RegressorScore& scored) {
  const Regressor series = series_regressor(s, entry);
  const Eigen::VectorXd amplitude = scored.theta.cwiseProduct(series.typical);
  const auto each = amplitude.size() / static_cast<Eigen::Index>(entry.joints.size());
  std::vector<std::pair<double, int>> square;  // mean over a turn, and joint
  for (std::size_t i = 0; i < entry.joints.size(); ++i)
    square.emplace_back(
        0.5 * amplitude.segment(static_cast<Eigen::Index>(i) * each, each).squaredNorm(),
        entry.joints[i]);
  std::sort(square.rbegin(), square.rend());
  std::string out;
  double told = 0.0;
  for (std::size_t i = 0; i < square.size(); ++i) {
    if (i > 0 && told > kMostOfSizes * 0.5 * amplitude.squaredNorm())
      return out + ", less at the others";
    const double size = 1e6 * std::sqrt(square[i].first);
    const auto& joint = s.cell->nominal.joints[static_cast<std::size_t>(square[i].second)].name;
    out += i == 0 ? fmt::format("{:.1f} µrad RMS at {}", size, joint)
                  : fmt::format(", {:.1f} at {}", size, joint);
    told += square[i].first;
  }
  return out;
}

std::string peaks_of(const WhitenedFit& s, const EffectEntry& entry, const RegressorScore& scored) {
  const Regressor series = series_regressor(s, entry);
  format::Model model;
  model.calibrated = s.cell->nominal;
  model.effects = {bind_effect(*s.cell, *s.measured, entry)};
  for (Eigen::Index c = 0; c < scored.theta.size(); ++c)
    model.effects[0].parameters[static_cast<std::size_t>(c)] = scored.theta(c) * series.typical(c);
  return series_words(*s.cell, model);
}

}  // namespace plumb::offline
