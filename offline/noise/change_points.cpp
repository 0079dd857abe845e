// SPDX-License-Identifier: Apache-2.0
#include "noise/change_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "noise/explained.hpp"

namespace plumb::offline {
namespace {

constexpr double kChance = 0.01;
constexpr double kChi95 = 3.84;
constexpr int kFewestVisits = 16;
constexpr std::size_t kMostSteps = 12;
constexpr int kBackfittingRounds = 2;

class Scanner {
 public:
  explicit Scanner(const StepMotions& motions) : motions_(motions), error_(3, motions.size()) {
    for (int i = 0; i < motions.size(); ++i) error_.col(i) = motions.error(i);
    for (const MovingPart& part : moving_parts(motions.joints())) take(part);
  }

  Changes scan() {
    Changes out;
    if (motions_.size() < kFewestVisits || sources_.empty()) return out;
    out.visits = motions_.size();
    look(VisitRun{0, motions_.size()}, out);
    if (found_.size() > 1)
      settle(found_, kBackfittingRounds, [&](Jumped& jumped) { return refine(jumped); });
    std::sort(found_.begin(), found_.end(),
              [](const auto& a, const auto& b) { return a.cut < b.cut; });
    for (auto& jumped : found_) out.steps.push_back(std::move(jumped.step));
    return out;
  }

 private:
  struct Jumped {
    std::size_t source;
    int cut;
    MotionSums::Numbers jump;
    StepFound step;
  };

  void take(const MovingPart& part) {
    MotionSums sums(motions_, part);
    if (sums.rank() > 0) sources_.push_back(std::move(sums));
  }

  Unexplained task() const {
    return {error_, motions_.axes(), static_cast<double>(sources_.size())};
  }

  void look(const VisitRun& s, Changes& out) {
    if (found_.size() >= kMostSteps) return;
    std::optional<Explained> best, smooth;
    const auto better = [](const std::optional<Explained>& a, std::optional<Explained>& b) {
      if (a && (!b || a->ln_p < b->ln_p)) b = a;
    };
    for (auto& sums : sources_) {
      sums.sum(error_);
      better(jump_of(sums, s, task()), best);
    }
    if (!best || best->ln_p > std::log(kChance)) return;
    for (const auto& sums : sources_) better(drift_of(sums, s, task()), smooth);
    const bool drifts = smooth && smooth->ln_p < best->ln_p;
    if (drifts) {
      smooth->take_from(error_);
      if (without_steps_.cols() > 0) smooth->take_from(without_steps_);
      if (out.drifts.size() >= kMostSteps) return;
      out.drifts.push_back(described(*smooth, s));
      return look(s, out);
    }
    if (found_.empty()) without_steps_ = error_;
    found_.push_back(jumped(*best, s));
    best->take_from(error_);
    look({s.first, best->cut}, out);
    look({best->cut, s.last}, out);
  }

  Jumped jumped(const Explained& e, const VisitRun& s) const {
    return {static_cast<std::size_t>(e.sums - sources_.data()), e.cut, e.behind - e.before,
            step(e, s)};
  }

  /// Finds the cut of one step again with all other steps removed. In the first search some of
  /// them were still present, or had been removed together with a part of this one. Returns whether
  /// the cut was found again, with another size at least.
  bool refine(Jumped& one) {
    error_ = without_steps_;
    int first = 0, last = motions_.size();
    for (const auto& other : found_) {
      if (&other == &one) continue;
      for (int i = other.cut; i < motions_.size(); ++i)
        error_.col(i) -= sources_[other.source].at(i) * other.jump;
      (other.cut < one.cut ? first : last) =
          other.cut < one.cut ? std::max(first, other.cut) : std::min(last, other.cut);
    }
    MotionSums& sums = sources_[one.source];
    sums.sum(error_);
    const auto again = jump_of(sums, {0, motions_.size()}, task());
    if (!again || again->cut <= first || again->cut >= last) return false;
    const double ln_p = one.step.ln_p;
    one = jumped(*again, {0, motions_.size()});
    one.step.ln_p = ln_p;
    return true;
  }

  DriftFound described(const Explained& e, const VisitRun& s) const {
    const int tenth = std::max(1, s.size() / 10);
    DriftFound out{.source = e.sums->source(), .joint = e.sums->joint(), .ln_p = e.ln_p};
    out.from = motions_.rows()[static_cast<std::size_t>(s.first)];
    out.to = motions_.rows()[static_cast<std::size_t>(s.last - 1)];
    // The same drift moves the points of different poses differently: compare its parameters.
    VisitRun head{s.first, s.first + tenth};
    VisitRun tail{s.last - tenth, s.last};
    MotionSums again = *e.sums;
    Eigen::Matrix3Xd all = Eigen::Matrix3Xd::Zero(3, motions_.size());
    for (int i = s.first; i < s.last; ++i) all.col(i) = e.at(i);
    again.sum(all);
    const MotionSums::Numbers moved =
        again.solve(tail.first, tail.last) - again.solve(head.first, head.last);
    out.size_m = rms(*e.sums, s, moved);
    return out;
  }

  static double rms(const MotionSums& sums, const VisitRun& s, const MotionSums::Numbers& numbers) {
    double squares = 0.0;
    for (int i = s.first; i < s.last; ++i) squares += (sums.at(i) * numbers).squaredNorm();
    return std::sqrt(squares / s.size());
  }

  /// Must be called while `e.sums` still holds the residual in which the step was found.
  StepFound step(const Explained& e, const VisitRun& s) const {
    const MotionSums& sums = *e.sums;
    const MotionSums::Numbers moved = e.behind - e.before;
    StepFound out;
    out.source = sums.source();
    out.joint = sums.joint();
    out.ln_p = e.ln_p;
    out.shift = sums.physical(moved);
    out.size_m = rms(sums, s, moved);
    out.before = motions_.last_rows()[static_cast<std::size_t>(e.cut - 1)];
    out.after = motions_.rows()[static_cast<std::size_t>(e.cut)];
    const MotionSums::Gain gain(sums, s.first, s.last);
    const double enough = e.gain - kChi95 * e.inflation * e.left / e.free;
    int low = e.cut, high = e.cut;
    const CutRange cuts = cuts_of(s, fewest_visits(sums));
    for (int c = cuts.first; c <= cuts.last; ++c) {
      if (gain(c) - gain.whole() < enough) continue;
      low = std::min(low, c);
      high = std::max(high, c);
    }
    out.earliest = motions_.last_rows()[static_cast<std::size_t>(low - 1)];
    out.latest = motions_.last_rows()[static_cast<std::size_t>(high - 1)];
    return out;
  }

  const StepMotions& motions_;
  Eigen::Matrix3Xd error_;          // residuals minus steps and drifts found so far
  Eigen::Matrix3Xd without_steps_;  // residuals minus drifts only, once a step was found
  std::vector<MotionSums> sources_;
  std::vector<Jumped> found_;
};

}  // namespace

Changes change_points(const StepMotions& motions) { return Scanner(motions).scan(); }

}  // namespace plumb::offline
