// SPDX-License-Identifier: Apache-2.0
#include "noise/explained.hpp"

#include <algorithm>
#include <cmath>

#include "noise/constants.hpp"
#include "numbers/cholesky.hpp"
#include "numbers/tails.hpp"

namespace plumb::offline {
namespace {

/// Factor by which the autocorrelation of a series inflates the variance of its mean: the sum of
/// its autocorrelations with Bartlett weights, or that of a first-order autoregressive process if
/// this is larger; at least 1. The weighted sum over the lags 0 ... L equals the mean square of the
/// sums of L + 1 successive values, so that one pass over the series is enough. The last lag is
/// 2 n^(1/3), at most n / 4. [Newey & West 1987]
class VarianceInflation {
 public:
  VarianceInflation(int visits, Eigen::Index numbers)
      : lags_(std::min(visits / 4, static_cast<int>(2.0 * std::cbrt(visits)))),
        window_(Eigen::MatrixXd::Zero(numbers, lags_ + 1)),
        sum_(Eigen::VectorXd::Zero(numbers)) {}

  void add(const Eigen::Ref<const Eigen::VectorXd>& value) {
    whole_ += value.squaredNorm();
    next_ += value.dot(window_.col((place_ + lags_) % (lags_ + 1)));
    shift(value);
  }

  double whole() const { return whole_; }

  double factor() {
    if (!(whole_ > 0.0)) return 1.0;
    for (int i = 0; i < lags_; ++i) shift(Eigen::VectorXd::Zero(sum_.size()));
    const double first = lags_ > 0 ? std::clamp(next_ / whole_, 0.0, kMostAutocorrelation) : 0.0;
    return std::max({1.0, sums_ / (lags_ + 1.0) / whole_, (1.0 + first) / (1.0 - first)});
  }

 private:
  /// The sum of the window is computed anew once per round, so that rounding errors do not add up.
  void shift(const Eigen::Ref<const Eigen::VectorXd>& value) {
    sum_ += value - window_.col(place_);
    window_.col(place_) = value;
    place_ = (place_ + 1) % (lags_ + 1);
    if (place_ == 0) sum_ = window_.rowwise().sum();
    sums_ += sum_.squaredNorm();
  }

  int lags_, place_ = 0;
  Eigen::MatrixXd window_;
  Eigen::VectorXd sum_;
  double whole_ = 0.0, next_ = 0.0, sums_ = 0.0;
};

/// The residual of a segment after `e` was subtracted, and how much its correlations inflate the
/// variance of what was fitted.
class SegmentResidual {
 public:
  SegmentResidual(const VisitRun& s, const Explained& e, const Eigen::Matrix3Xd& error)
      : e_(e),
        rest_(s.size(), 3),
        scores_(s.size(), e.sums->rank()),
        along_(s.size(), 1),
        left_(e.cut - s.first),
        right_(s.last - e.cut) {
    for (int i = s.first; i < s.last; ++i) add(i, error.col(i) - e.at(i));
  }

  double squares() const { return rest_.whole(); }

  /// Variance of the fitted numbers over the variance that independent residuals of equal variance
  /// would give them. A missing effect makes residuals larger in some directions than in others,
  /// and alike at neighbouring visits. Computed from the scores X_i^T r_i of the visits, on average
  /// and along the jump that was found, and from their autocorrelation; at least 1. [White 1980;
  /// Newey & West 1987]
  double inflation() {
    const double variance = squares() / std::max(1.0, e_.free);
    if (!(variance > 0.0) || !(motion_ > 0.0)) return 1.0;
    double out = scores_.whole() / (variance * motion_) * scores_.factor();
    if (e_.cut > 0) {
      const double pooled = along_.whole() / whole_;
      out = std::max(out, std::max(pooled, weighted_ / weights_) / variance * along_.factor());
    }
    return std::max({1.0, out, rest_.factor()});
  }

 private:
  void add(int visit, const Eigen::Vector3d& rest) {
    const MotionSums::Columns X = e_.sums->at(visit);
    const MotionSums::Numbers score = X.transpose() * rest;
    rest_.add(rest);
    scores_.add(score);
    motion_ += X.squaredNorm();
    if (e_.cut == 0) return;
    const MotionSums::Numbers jump = e_.behind - e_.before;
    const double n = visit < e_.cut ? left_ : right_;
    const double size = (X * jump).squaredNorm();
    Eigen::Matrix<double, 1, 1> along;
    along(0) = jump.dot(score);
    along_.add(along);
    weighted_ += along(0) * along(0) / (n * n);
    weights_ += size / (n * n);
    whole_ += size;
  }

  const Explained& e_;
  VarianceInflation rest_, scores_, along_;
  double left_, right_;  // visits on either side of a jump
  double motion_ = 0.0, weighted_ = 0.0, weights_ = 0.0, whole_ = 0.0;
};

/// Fills in the F test of `out`. tries: number of alternatives for the Bonferroni correction.
void judge(const VisitRun& s, int numbers, double tries, const Unexplained& what, Explained& out) {
  SegmentResidual rest(s, out, what.error);
  out.inflation = rest.inflation();
  out.left = rest.squares();
  if (out.free < 1.0 || !(out.left > 0.0)) return;
  const double f = out.gain / numbers / (out.left / out.free) / out.inflation;
  out.ln_p = std::min(0.0, ln_f_tail(f, numbers, out.free) + std::log(tries));
}

/// Position of a visit within its segment, from -1 at the first to 1 at the last visit.
double place_in(const VisitRun& s, int visit) {
  return 2.0 * (visit - s.first) / (s.size() - 1.0) - 1.0;
}

}  // namespace

Eigen::Vector3d Explained::at(int visit) const {
  const MotionSums::Columns X = sums->at(visit);
  if (cut > 0) return X * (visit < cut ? before : behind);
  const double t = place_in(segment, visit);
  const int k = sums->rank();
  return X * (drift.head(k) + t * drift.segment(k, k) + t * t * drift.tail(k));
}

int fewest_visits(const MotionSums& sums) { return std::max(kFewestBesideJump, sums.rank() + 2); }

std::optional<Explained> jump_of(const MotionSums& sums, const VisitRun& s,
                                 const Unexplained& what) {
  const int edge = fewest_visits(sums);
  if (s.size() < 2 * edge) return std::nullopt;
  const MotionSums::Gain gain(sums, s.first, s.last);
  Explained out;
  out.sums = &sums;
  const CutRange cuts = cuts_of(s, edge);
  const auto best = best_cut(
      s.last, cuts, [](int) {},
      [&](int cut) -> std::optional<double> { return gain(cut) - gain.whole(); });
  if (!best || !(best->score > 0.0)) return std::nullopt;
  out.cut = best->cut;
  out.gain = best->score;
  out.segment = s;
  out.before = sums.solve(s.first, out.cut);
  out.behind = sums.solve(out.cut, s.last);
  out.free = what.axes * s.size() - 2.0 * sums.rank();
  judge(s, sums.rank(), cuts.count() * what.sources, what, out);
  return out;
}

std::optional<Explained> drift_of(const MotionSums& sums, const VisitRun& s,
                                  const Unexplained& what) {
  const int k = sums.rank();
  if (what.axes * s.size() < kFewestOfDrift * k) return std::nullopt;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(3 * k, 3 * k);
  Eigen::VectorXd along = Eigen::VectorXd::Zero(3 * k);
  for (int i = s.first; i < s.last; ++i) {
    const double t = place_in(s, i);
    const MotionSums::Columns X = sums.at(i);
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 18> x(3, 3 * k);
    x << X, X * t, X * (t * t);
    gram += x.transpose() * x;
    along += x.transpose() * what.error.col(i);
  }
  gram.diagonal().array() += 1e-9 * s.size();
  Explained out;
  out.sums = &sums;
  out.segment = s;
  out.drift = Cholesky(gram).solve(along);
  out.gain = out.drift.dot(along) - sums.explained(s.first, s.last);
  out.free = what.axes * s.size() - 3.0 * k;
  judge(s, 2 * k, what.sources, what, out);
  return out;
}

}  // namespace plumb::offline
