// SPDX-License-Identifier: Apache-2.0
#include "compare/change_points.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "compare/f_tail.hpp"
#include "compare/mover_sums.hpp"

namespace plumb::offline::compare {
namespace {

constexpr double kChance = 0.01;
constexpr double kChi95 = 3.84;
constexpr int kFewestInSegment = 5;
constexpr int kFewestVisits = 16;
constexpr std::size_t kMostSteps = 12;

struct Segment {
  int first, last;  // visits [first, last)
  int size() const { return last - first; }
};

/// What one mover explains of a segment, by a jump or by a drift.
struct Explained {
  const MoverSums* sums = nullptr;
  int cut = 0;
  double gain = 0.0, left = 0.0;  // sums of squares
  double inflation = 1.0;         // of F, see inflation()
  double free = 1.0;              // degrees of freedom left
  double ln_p = 0.0;
  Eigen::Matrix3Xd fitted;  // shape (3, segment)
};

class Scanner {
 public:
  explicit Scanner(const StepMotions& motions) : motions_(motions), error_(3, motions.size()) {
    for (int i = 0; i < motions.size(); ++i) error_.col(i) = motions.error(i);
    take(Mover::kTool, -1);
    take(Mover::kBase, -1);
    for (int j = 0; j < motions.joints(); ++j) take(Mover::kJoint, j);
  }

  Changes scan() {
    Changes out;
    if (motions_.size() < kFewestVisits || movers_.empty()) return out;
    out.visits = motions_.size();
    without_steps_ = error_;
    look(Segment{0, motions_.size()}, out);
    for (int pass = 0; pass < 2 && found_.size() > 1; ++pass)
      for (auto& jumped : found_) refine(jumped);
    std::sort(found_.begin(), found_.end(),
              [](const auto& a, const auto& b) { return a.cut < b.cut; });
    for (auto& jumped : found_) out.steps.push_back(std::move(jumped.step));
    return out;
  }

 private:
  struct Jumped {
    std::size_t mover;
    int cut;
    MoverSums::Numbers jump;
    StepFound step;
  };

  void take(Mover mover, int joint) {
    MoverSums sums(motions_, mover, joint);
    if (sums.rank() > 0) movers_.push_back(std::move(sums));
  }

  int fewest(const MoverSums& sums) const { return std::max(kFewestInSegment, sums.rank() + 2); }

  double squares(const Segment& s) const {
    return error_.middleCols(s.first, s.size()).squaredNorm();
  }

  /// Variance of what is fitted over that which independent residuals of one size would give it:
  /// a law that the model lacks shakes some directions more than others, and neighbours alike. By
  /// the scores of each visit, X_i^T r_i on their average or along the jump found, and their
  /// autocorrelation; at least 1. [White 1980; Newey & West 1987]
  double inflation(const Segment& s, const Explained& e, const Eigen::Matrix3Xd& rest) const {
    const MoverSums& sums = *e.sums;
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
    const MoverSums::Numbers jump = sums.solve(e.cut, s.last) - sums.solve(s.first, e.cut);
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

  /// What the memory of a series adds to the variance of its mean: the sum of its autocorrelations
  /// with Bartlett weights, or as if it were autoregressive; at least 1.
  static double memory(const Eigen::MatrixXd& series) {
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

  /// F with its chance, given what is fitted.
  void judge(const Segment& s, int numbers, double tries, Explained& out) const {
    const Eigen::Matrix3Xd rest = error_.middleCols(s.first, s.size()) - out.fitted;
    out.inflation = std::max(1.0, inflation(s, out, rest));
    out.left = rest.squaredNorm();
    if (out.free < 1.0 || !(out.left > 0.0)) return;
    const double f = out.gain / numbers / (out.left / out.free) / out.inflation;
    out.ln_p = std::min(0.0, ln_f_tail(f, numbers, out.free) + std::log(tries));
  }

  std::optional<Explained> jump(const MoverSums& sums, const Segment& s) const {
    const int edge = fewest(sums);
    if (s.size() < 2 * edge) return std::nullopt;
    const double whole = sums.explained(s.first, s.last);
    Explained out;
    out.sums = &sums;
    for (int c = s.first + edge; c <= s.last - edge; ++c) {
      const double gain = sums.explained(s.first, c) + sums.explained(c, s.last) - whole;
      if (gain > out.gain) out.gain = gain, out.cut = c;
    }
    if (out.cut == 0) return std::nullopt;
    out.fitted.resize(3, s.size());
    fill(sums, {s.first, out.cut}, s.first, out.fitted);
    fill(sums, {out.cut, s.last}, s.first, out.fitted);
    out.free = motions_.axes() * s.size() - 2.0 * sums.rank();
    judge(s, sums.rank(), (s.size() - 2.0 * edge + 1.0) * static_cast<double>(movers_.size()), out);
    return out;
  }

  static void fill(const MoverSums& sums, const Segment& part, int offset, Eigen::Matrix3Xd& out) {
    const auto numbers = sums.solve(part.first, part.last);
    for (int i = part.first; i < part.last; ++i) out.col(i - offset) = sums.at(i) * numbers;
  }

  /// Motion constant, linear and quadratic in order.
  std::optional<Explained> drift(const MoverSums& sums, const Segment& s) const {
    const int k = sums.rank();
    if (motions_.axes() * s.size() < 6 * k) return std::nullopt;
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
      along += x.transpose() * error_.col(i);
    }
    gram.diagonal().array() += 1e-9 * s.size();
    const Eigen::VectorXd numbers = gram.llt().solve(along);
    Explained out;
    out.sums = &sums;
    out.gain = numbers.dot(along) - sums.explained(s.first, s.last);
    out.fitted.resize(3, s.size());
    for (int i = s.first; i < s.last; ++i) out.fitted.col(i - s.first) = wide(i) * numbers;
    out.free = motions_.axes() * s.size() - 3.0 * k;
    judge(s, 2 * k, static_cast<double>(movers_.size()), out);
    return out;
  }

  void look(const Segment& s, Changes& out) {
    if (found_.size() >= kMostSteps) return;
    std::optional<Explained> best, smooth;
    const auto better = [](const std::optional<Explained>& a, std::optional<Explained>& b) {
      if (a && (!b || a->ln_p < b->ln_p)) b = a;
    };
    for (auto& sums : movers_) {
      sums.sum(error_);
      better(jump(sums, s), best);
    }
    if (!best || best->ln_p > std::log(kChance)) return;
    for (const auto& sums : movers_) better(drift(sums, s), smooth);
    const bool drifts = smooth && smooth->ln_p < best->ln_p;
    error_.middleCols(s.first, s.size()) -= drifts ? smooth->fitted : best->fitted;
    if (drifts) {
      without_steps_.middleCols(s.first, s.size()) -= smooth->fitted;
      if (out.drifts.size() >= kMostSteps) return;
      out.drifts.push_back(described(*smooth, s));
      return look(s, out);
    }
    found_.push_back(jumped(*best, s));
    look({s.first, best->cut}, out);
    look({best->cut, s.last}, out);
  }

  Jumped jumped(const Explained& e, const Segment& s) const {
    return {static_cast<std::size_t>(e.sums - movers_.data()), e.cut,
            e.sums->solve(e.cut, s.last) - e.sums->solve(s.first, e.cut), step(e, s)};
  }

  /// The cut of one step again, the others taken away: where it was found they were still there,
  /// or had been taken away together with a part of it.
  void refine(Jumped& one) {
    error_ = without_steps_;
    int first = 0, last = motions_.size();
    for (const auto& other : found_) {
      if (&other == &one) continue;
      for (int i = other.cut; i < motions_.size(); ++i)
        error_.col(i) -= movers_[other.mover].at(i) * other.jump;
      (other.cut < one.cut ? first : last) =
          other.cut < one.cut ? std::max(first, other.cut) : std::min(last, other.cut);
    }
    MoverSums& sums = movers_[one.mover];
    sums.sum(error_);
    const auto again = jump(sums, {0, motions_.size()});
    if (!again || again->cut <= first || again->cut >= last) return;
    const double ln_p = one.step.ln_p;
    one = jumped(*again, {0, motions_.size()});
    one.step.ln_p = ln_p;
  }

  DriftFound described(const Explained& e, const Segment& s) const {
    const auto n = e.fitted.cols();
    const Eigen::Index tenth = std::max<Eigen::Index>(1, n / 10);
    DriftFound out{.mover = e.sums->mover(), .joint = e.sums->joint(), .ln_p = e.ln_p};
    out.from = motions_.rows()[static_cast<std::size_t>(s.first)];
    out.to = motions_.rows()[static_cast<std::size_t>(s.last - 1)];
    // The pose changes the direction in which a drift shows, so its numbers are compared, not it.
    Segment head{s.first, s.first + static_cast<int>(tenth)};
    Segment tail{s.last - static_cast<int>(tenth), s.last};
    MoverSums again = *e.sums;
    Eigen::Matrix3Xd all = Eigen::Matrix3Xd::Zero(3, motions_.size());
    all.middleCols(s.first, s.size()) = e.fitted;
    again.sum(all);
    const MoverSums::Numbers moved =
        again.solve(tail.first, tail.last) - again.solve(head.first, head.last);
    out.size_m = rms(*e.sums, s, moved);
    return out;
  }

  static double rms(const MoverSums& sums, const Segment& s, const MoverSums::Numbers& numbers) {
    double squares = 0.0;
    for (int i = s.first; i < s.last; ++i) squares += (sums.at(i) * numbers).squaredNorm();
    return std::sqrt(squares / s.size());
  }

  /// Must be called with the sums of the residual in which it was found.
  StepFound step(const Explained& e, const Segment& s) const {
    const MoverSums& sums = *e.sums;
    const MoverSums::Numbers moved = sums.solve(e.cut, s.last) - sums.solve(s.first, e.cut);
    StepFound out;
    out.mover = sums.mover();
    out.joint = sums.joint();
    out.ln_p = e.ln_p;
    out.shift = sums.physical(moved);
    out.size_m = rms(sums, s, moved);
    out.before = motions_.last_rows()[static_cast<std::size_t>(e.cut - 1)];
    out.after = motions_.rows()[static_cast<std::size_t>(e.cut)];
    const double whole = sums.explained(s.first, s.last);
    const double enough = e.gain - kChi95 * e.inflation * e.left / e.free;
    int low = e.cut, high = e.cut;
    for (int c = s.first + fewest(sums); c <= s.last - fewest(sums); ++c) {
      if (sums.explained(s.first, c) + sums.explained(c, s.last) - whole < enough) continue;
      low = std::min(low, c);
      high = std::max(high, c);
    }
    out.earliest = motions_.last_rows()[static_cast<std::size_t>(low - 1)];
    out.latest = motions_.last_rows()[static_cast<std::size_t>(high - 1)];
    return out;
  }

  const StepMotions& motions_;
  Eigen::Matrix3Xd error_;          // less what was found so far
  Eigen::Matrix3Xd without_steps_;  // the residuals less drifts
  std::vector<MoverSums> movers_;
  std::vector<Jumped> found_;
};

}  // namespace

Changes change_points(const StepMotions& motions) { return Scanner(motions).scan(); }

}  // namespace plumb::offline::compare
