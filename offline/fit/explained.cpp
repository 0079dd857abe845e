// SPDX-License-Identifier: Apache-2.0
#include "fit/explained.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/cholesky.hpp"
#include "numbers/tails.hpp"

namespace plumb::offline {
namespace {

constexpr int kFewestInBin = 5;

/// Factor by which the autocorrelation of a series inflates the variance of its mean: the sum of
/// its autocorrelations with Bartlett weights, or that of a first-order autoregressive process if
/// this is larger; at least 1.
double memory(const Eigen::MatrixXd& series) {
  const auto n = static_cast<int>(series.cols());
  const double whole = series.squaredNorm();
  if (!(whole > 0.0)) return 1.0;
  const int lags = std::min(n / 4, static_cast<int>(2.0 * std::cbrt(n)));
  double sum = 1.0, first = 0.0;
  for (int lag = 1; lag <= lags; ++lag) {
    const int rest = n - lag;
    const double r = series.leftCols(rest).cwiseProduct(series.rightCols(rest)).sum() / whole;
    if (lag == 1) first = std::clamp(r, 0.0, 0.95);
    sum += 2.0 * (1.0 - lag / (lags + 1.0)) * r;
  }
  return std::max({1.0, sum, (1.0 + first) / (1.0 - first)});
}

/// Variance of the fitted numbers, over the variance that independent residuals of equal variance
/// would give them: a missing effect disturbs some directions more than others, and neighbouring
/// visits alike. From the scores X_i^T r_i of the visits, on average or along the jump found, and
/// their autocorrelation; at least 1. [White 1980; Newey & West 1987]
double inflation(const VisitRun& s, const Explained& e, const Eigen::Matrix3Xd& rest) {
  const MotionSums& sums = *e.sums;
  Eigen::MatrixXd scores(sums.rank(), s.size());
  double motion = 0.0;
  for (int i = 0; i < s.size(); ++i) {
    scores.col(i) = sums.at(s.first + i).transpose() * rest.col(i);
    motion += sums.at(s.first + i).squaredNorm();
  }
  const double variance = rest.squaredNorm() / std::max(1.0, e.free);
  if (!(variance > 0.0) || !(motion > 0.0)) return 1.0;
  double out = scores.squaredNorm() / (variance * motion) * memory(scores);
  if (e.cut == 0) return std::max(out, memory(rest));
  const MotionSums::Numbers jump = sums.solve(e.cut, s.last) - sums.solve(s.first, e.cut);
  const Eigen::RowVectorXd along = jump.transpose() * scores;
  const int left = e.cut - s.first, right = s.last - e.cut;
  double weighted = 0.0, weights = 0.0, whole = 0.0;
  for (int i = 0; i < s.size(); ++i) {
    const double n = i < left ? left : right;
    const double size = (sums.at(s.first + i) * jump).squaredNorm();
    weighted += along(i) * along(i) / (n * n);
    weights += size / (n * n);
    whole += size;
  }
  const double pooled = along.squaredNorm() / whole;
  out = std::max(out, std::max(pooled, weighted / weights) / variance * memory(along));
  return std::max(out, memory(rest));
}

/// Fills in the F test of `out.fitted`; tries: number of alternatives for the Bonferroni
/// correction.
void judge(const VisitRun& s, int numbers, double tries, const Unexplained& what, Explained& out) {
  const Eigen::Matrix3Xd rest = what.error.middleCols(s.first, s.size()) - out.fitted;
  out.inflation = std::max(1.0, inflation(s, out, rest));
  out.left = rest.squaredNorm();
  if (out.free < 1.0 || !(out.left > 0.0)) return;
  const double f = out.gain / numbers / (out.left / out.free) / out.inflation;
  out.ln_p = std::min(0.0, ln_f_tail(f, numbers, out.free) + std::log(tries));
}

void fill(const MotionSums& sums, const VisitRun& part, int offset, Eigen::Matrix3Xd& out) {
  const auto numbers = sums.solve(part.first, part.last);
  for (int i = part.first; i < part.last; ++i) out.col(i - offset) = sums.at(i) * numbers;
}

}  // namespace

int fewest_visits(const MotionSums& sums) { return std::max(kFewestInBin, sums.rank() + 2); }

std::optional<Explained> jump_of(const MotionSums& sums, const VisitRun& s,
                                 const Unexplained& what) {
  const int edge = fewest_visits(sums);
  if (s.size() < 2 * edge) return std::nullopt;
  const double whole = sums.explained(s.first, s.last);
  Explained out;
  out.sums = &sums;
  const CutRange cuts = cuts_of(s, edge);
  const auto best = best_cut(
      s.last, cuts, [](int) {},
      [&](int cut) -> std::optional<double> { return sums.gain(s.first, cut, s.last) - whole; });
  if (!best || !(best->score > 0.0)) return std::nullopt;
  out.cut = best->cut;
  out.gain = best->score;
  out.fitted.resize(3, s.size());
  fill(sums, {s.first, out.cut}, s.first, out.fitted);
  fill(sums, {out.cut, s.last}, s.first, out.fitted);
  out.free = what.axes * s.size() - 2.0 * sums.rank();
  judge(s, sums.rank(), cuts.count() * what.sources, what, out);
  return out;
}

std::optional<Explained> drift_of(const MotionSums& sums, const VisitRun& s,
                                  const Unexplained& what) {
  const int k = sums.rank();
  if (what.axes * s.size() < 6 * k) return std::nullopt;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(3 * k, 3 * k);
  Eigen::VectorXd along = Eigen::VectorXd::Zero(3 * k);
  const auto wide = [&](int i) {
    const double t = 2.0 * (i - s.first) / (s.size() - 1.0) - 1.0;
    Eigen::MatrixXd x(3, 3 * k);
    x << sums.at(i), sums.at(i) * t, sums.at(i) * (t * t);
    return x;
  };
  for (int i = s.first; i < s.last; ++i) {
    const Eigen::MatrixXd x = wide(i);
    gram += x.transpose() * x;
    along += x.transpose() * what.error.col(i);
  }
  gram.diagonal().array() += 1e-9 * s.size();
  const Eigen::VectorXd numbers = Cholesky(gram).solve(along);
  Explained out;
  out.sums = &sums;
  out.gain = numbers.dot(along) - sums.explained(s.first, s.last);
  out.fitted.resize(3, s.size());
  for (int i = s.first; i < s.last; ++i) out.fitted.col(i - s.first) = wide(i) * numbers;
  out.free = what.axes * s.size() - 3.0 * k;
  judge(s, 2 * k, what.sources, what, out);
  return out;
}

}  // namespace plumb::offline
