// SPDX-License-Identifier: Apache-2.0
#include "diagnose/ripple_scan.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "diagnose/constants.hpp"
#include "numbers/cholesky.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kTogether = 16;  // waves judged in one pass over the poses
constexpr int kIterations = 4;
constexpr double kLeastShare = 0.2;  // of a step

/// Gram matrix and products of all waves, cleared of the model and of what was picked.
struct Field {
  Eigen::MatrixXd gram;
  Eigen::VectorXd v;
  double Q = 0.0;

  /// Evidence of wave k alone, by what is left.
  Evidence of(std::size_t k, const EvidenceScale& scale) const {
    const auto at = static_cast<Eigen::Index>(2 * k);
    return evidence(gram.block(at, at, 2, 2), v.segment(at, 2), Q, scale);
  }

  /// Takes wave k out of everything.
  void pick(std::size_t k) {
    const auto at = static_cast<Eigen::Index>(2 * k);
    Eigen::Matrix2d own = gram.block(at, at, 2, 2);
    own.diagonal().array() += 1e-9 * own.trace();
    const Eigen::Matrix2d inverse = own.inverse();
    const Eigen::MatrixXd across = gram.middleCols(at, 2);
    const Eigen::Vector2d theta = inverse * v.segment(at, 2);
    Q -= v.segment(at, 2).dot(theta);
    v -= across * theta;
    gram -= across * (inverse * across.transpose());
  }
};

/// Whether the range of the joint can tell a wave from all the others. Closer ones would be fitted
/// as huge waves against each other.
bool apart(double wave, const std::vector<double>& others, double step) {
  return std::none_of(others.begin(), others.end(), [&](double other) {
    return other != wave && std::abs(other - wave) < kLeastSteps * step;
  });
}

double rounded(double cycles) { return std::round(100.0 * cycles) / 100.0; }

/// The columns of the waves, followed by their derivatives with respect to the wave numbers.
Regressor with_slopes(const WhitenedFit& s, const Regressor& waves, const Eigen::VectorXd& theta) {
  Regressor out = waves;
  const Eigen::Index count = waves.columns.cols() / 2;
  out.columns.conservativeResize(Eigen::NoChange, 3 * count);
  for (Eigen::Index i = 0; i < s.poses(); ++i) {
    const double q = s.q(i)[waves.joint];
    for (Eigen::Index k = 0; k < count; ++k)
      out.columns(i, 2 * count + k) = q * (theta(2 * k) * waves.columns(i, 2 * k + 1) -
                                           theta(2 * k + 1) * waves.columns(i, 2 * k));
  }
  return out;
}

double step_of(const std::vector<double>& grid) {
  return grid.size() > 1 ? grid[1] - grid[0] : 0.5;
}

/// Picks waves of the grid one after the other, at most so many.
Ripples picked(Field field, const std::vector<double>& grid, const EvidenceScale& scale,
               double price, std::size_t most_waves) {
  Ripples out{.joint = 0, .cycles = {}, .strongest_ln_bayes = -1e6};
  while (out.cycles.size() < most_waves) {
    std::size_t best = 0;
    double most = -1e6;
    for (std::size_t k = 0; k < grid.size(); ++k) {
      if (!apart(grid[k], out.cycles, step_of(grid))) continue;
      const double ln = field.of(k, scale).ln_bayes;
      if (ln > most) most = ln, best = k;
    }
    if (out.cycles.empty()) out.strongest_ln_bayes = most;
    if (!out.cycles.empty() && most < price) break;
    out.cycles.push_back(grid[best]);
    if (most < price) break;
    field.pick(best);
  }
  return out;
}

double price_of_wave(double regressors, const std::vector<double>& grid) {
  return std::log(std::max(1.0, regressors + static_cast<double>(grid.size()))) + kWavePays;
}

/// Refines all wave numbers at once by Gauss-Newton steps, from the grid they were found on.
void refine(const Scorer& scorer, Ripples& out, double step) {
  Regressor waves = ripple_regressor(scorer.whitened(), out.joint, out.cycles);
  RegressorScore now = scorer.score(waves);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Products all = scorer.products(with_slopes(scorer.whitened(), waves, now.theta));
    Eigen::MatrixXd gram = all.XX - all.UX.transpose() * all.UX;
    gram.diagonal().array() += 1e-9 * gram.diagonal().maxCoeff();
    // The wave numbers of two close waves are strongly correlated: a prior keeps the steps small.
    const auto m = static_cast<Eigen::Index>(out.cycles.size());
    const double left = scorer.whitened().Q * (1.0 - now.explained) / scorer.scale().lines /
                        std::pow(0.25 * step, 2);
    gram.diagonal().tail(m).array() += left;
    const Eigen::VectorXd theta = SymmetricSolver(gram).solve(all.Xy);
    const Eigen::VectorXd change = theta.tail(m).cwiseMax(-0.5 * step).cwiseMin(0.5 * step);
    bool better = false;
    for (double share = 1.0; share > kLeastShare && !better; share *= 0.5) {
      auto moved = out.cycles;
      for (std::size_t k = 0; k < moved.size(); ++k)
        moved[k] = rounded(moved[k] + share * change(static_cast<Eigen::Index>(k)));
      if (!std::all_of(moved.begin(), moved.end(),
                       [&](double wave) { return apart(wave, moved, step); }))
        continue;
      const Regressor tried = ripple_regressor(scorer.whitened(), out.joint, moved);
      RegressorScore then = scorer.score(tried);
      if (then.evidence.ln_bayes <= now.evidence.ln_bayes) continue;
      better = true;
      out.cycles = moved;
      waves = tried;
      now = std::move(then);
    }
    if (!better) break;
  }
}

}  // namespace

Ripples scan_ripples(const Scorer& scorer, int joint, double regressors, int& tried) {
  const auto grid = ripple_grid(scorer.whitened(), joint);
  if (grid.empty()) return {.joint = joint, .cycles = {}, .strongest_ln_bayes = -1e6};
  tried += static_cast<int>(grid.size());
  const Products all = scorer.products(ripple_regressor(scorer.whitened(), joint, grid));
  const double price = price_of_wave(regressors, grid);
  Ripples out = picked({all.XX - all.UX.transpose() * all.UX, all.Xy, scorer.whitened().Q}, grid,
                       scorer.scale(), price, kMostWaves);
  out.joint = joint;
  if (out.strongest_ln_bayes >= price) refine(scorer, out, step_of(grid));
  return out;
}

Ripples scan_fast_ripples(const Scorer& scorer, int joint, int& tried) {
  Ripples out{.joint = joint, .cycles = {}, .strongest_ln_bayes = kImpossible};
  const auto grid = fast_ripple_grid(scorer.whitened(), joint);
  tried += static_cast<int>(grid.size());
  for (std::size_t first = 0; first < grid.size(); first += kTogether) {
    const std::vector<double> waves(
        grid.begin() + static_cast<std::ptrdiff_t>(first),
        grid.begin() + static_cast<std::ptrdiff_t>(std::min(first + kTogether, grid.size())));
    const Products all = scorer.products(ripple_regressor(scorer.whitened(), joint, waves));
    for (std::size_t k = 0; k < waves.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(2 * k);
      const auto UX = all.UX.middleCols(at, 2);
      const Evidence found = evidence(all.XX.block(at, at, 2, 2) - UX.transpose() * UX,
                                      all.Xy.segment(at, 2), scorer.whitened().Q, scorer.scale());
      if (found.ln_bayes <= out.strongest_ln_bayes) continue;
      out.strongest_ln_bayes = found.ln_bayes;
      out.cycles = {waves[k]};
    }
  }
  if (out.cycles.empty()) return out;
  refine(scorer, out, step_of(grid));
  return out;
}

std::vector<std::vector<double>> waves_without_folds(const Scorer& scorer, int joint,
                                                     const std::vector<double>& chosen,
                                                     double regressors) {
  const WhitenedFit& s = scorer.whitened();
  std::vector<double> grid = ripple_grid(s, joint);
  const bool fast =
      chosen.size() == 1 && !grid.empty() &&
      chosen.front() > *std::max_element(grid.begin(), grid.end()) + kLeastSteps * step_of(grid);
  if (fast) grid = fast_ripple_grid(s, joint);
  std::vector<std::vector<double>> out(s.folds.size());
  if (grid.empty()) return out;
  const auto by_fold = scorer.products_by_fold(ripple_regressor(s, joint, grid));
  const double price = price_of_wave(regressors, grid);
  for (std::size_t f = 0; f < s.folds.size(); ++f) {
    Scorer::Cleared there = scorer.cleared_without(f, by_fold);
    out[f] = picked({std::move(there.XX), std::move(there.Xy), there.Q}, grid, there.scale, price,
                    fast ? 1 : kMostWaves)
                 .cycles;
    for (double& wave : out[f])
      for (const double refined : chosen)
        if (std::abs(refined - wave) < step_of(grid)) {
          wave = refined;
          break;
        }
  }
  return out;
}

std::vector<RegressorScore> scored_without_folds(const Scorer& scorer, int joint,
                                                 const std::vector<std::vector<double>>& waves) {
  std::vector<RegressorScore> out;
  for (const auto& cycles : waves)
    out.push_back(cycles.empty()
                      ? RegressorScore{}
                      : scorer.score(ripple_regressor(scorer.whitened(), joint, cycles)));
  return out;
}

}  // namespace plumb::offline
