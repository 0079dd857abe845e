// SPDX-License-Identifier: Apache-2.0
#include "recheck/recheck.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "arm/arm_change.hpp"
#include "arm/predicted_points.hpp"
#include "fit/calibrate.hpp"
#include "fit/verdict.hpp"
#include "numbers/tails.hpp"
#include "recheck/constants.hpp"
#include "recheck/known_series.hpp"
#include "recheck/left_out.hpp"
#include "recheck/refit.hpp"
#include "recheck/search.hpp"

namespace plumb::offline::recheck {
namespace {

/// Gives the rows the order and the time of the calibration's last reading: parts that moved stay
/// where they are, and a drift has ended.
void place_at_the_end(const Measurements& own, Measurements& rows) {
  rows.context.order = Eigen::VectorXd::Constant(rows.size(), static_cast<double>(own.size()));
  rows.context.time_s.resize(0);
  double last = -HUGE_VAL;
  for (const double t : own.context.time_s)
    if (std::isfinite(t)) last = std::max(last, t);
  if (std::isfinite(last)) rows.context.time_s = Eigen::VectorXd::Constant(rows.size(), last);
}

/// ln of the probability that F(n, trusted) exceeds chi2 / n.
double ln_chance_of(double chi2, double n) { return ln_f_tail(chi2 / n, n, kTrusted); }

/// RMS distance of the measured points that two states predict, over some poses.
double motion_of(const Measurements& own, const ArmState& a, const ArmState& b) {
  return std::sqrt((predict_points(a, own) - predict_points(b, own)).squaredNorm() / own.size());
}

/// The poses of the calibration as poses of the set-up that is compared with.
Measurements poses_of(const Measurements& own, const Run& run) {
  std::vector<int> used;
  for (int i = 0; i < own.size(); ++i)
    if (run.fit.split.used[i]) used.push_back(i);
  Measurements out = pick(own, used);
  out.setup.clear();
  return pick(out, judged_rows(out.size()));
}

}  // namespace

std::vector<int> judged_rows(int size) {
  std::vector<int> out;
  const int count = std::min(size, kMostReadings);
  for (int i = 0; i < count; ++i)
    out.push_back(static_cast<int>(static_cast<long>(i) * size / count));
  return out;
}

bool undecided(const FoundChange& found) {
  return std::any_of(found.alternatives.begin(), found.alternatives.end(),
                     [](const Alternative& a) { return a.behind_nats < kUndecided && a.matters; });
}

const char* name_of(Recheck::Verdict verdict) {
  switch (verdict) {
    case Recheck::Verdict::kTrue:
      return "true";
    case Recheck::Verdict::kChanged:
      return "changed";
    case Recheck::Verdict::kUndecidable:
      break;
  }
  return "undecidable";
}

namespace {

std::vector<Change> assumed_changes(const Assumed& assumed, std::vector<Change>& possible) {
  std::vector<Change> out;
  for (auto change = possible.begin(); change != possible.end();) {
    const bool is_new = (change->part == Part::kBase && assumed.new_frame) ||
                        (change->part == Part::kTool && assumed.new_target);
    if (is_new) {
      out.push_back(*change);
      out.back().scales = {out.back().scales.back()};
      change = possible.erase(change);
    } else {
      ++change;
    }
  }
  return out;
}

std::vector<Alternative> alternatives_to(const Judge& judge, const Search& search, std::size_t k,
                                         const Measurements& own, double tolerance_m) {
  std::vector<Alternative> out;
  const Change& found = search.found()[k];
  for (const auto& change : search.possible()) {
    if (change.part == Part::kReading || search.holds(change)) continue;
    std::vector<Change> other = search.found();
    other[k] = change;
    const Judged judged = judge.judge(other);
    const double behind = search.last().ln_evidence + std::log(found.chance) - judged.ln_evidence -
                          std::log(change.chance);
    if (behind > kListed || !sizes_plausible(other, k, judged)) continue;
    out.push_back({change, behind,
                   motion_of(own, search.last().state, judged.state) > kSamePoints * tolerance_m});
  }
  std::sort(out.begin(), out.end(),
            [](const auto& a, const auto& b) { return a.behind_nats < b.behind_nats; });
  return out;
}

FoundChange described(const Judge& judge, const Search& search, std::size_t k,
                      const ArmState& extended, const Measurements& own, double tolerance_m) {
  const Judged& last = search.last();
  FoundChange out{.change = search.found()[k]};
  std::vector<Change> others = search.found();
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
  const Judged without_it = judge.judge(others);
  out.ln_bayes = last.ln_evidence - without_it.ln_evidence;
  const auto count = static_cast<Eigen::Index>(out.change.parameters.size());
  const Eigen::VectorXd std =
      last.x_covariance.diagonal().segment(last.begin[k], count).cwiseMax(0.0).cwiseSqrt();
  out.before = estimates_of(out.change, extended, Eigen::VectorXd::Zero(count));
  out.after = estimates_of(out.change, last.state, std);
  ArmState back = last.state;
  if (out.change.part == Part::kBase) back.X_MB = extended.X_MB;
  if (out.change.part == Part::kTool) back.X_TG = extended.X_TG;
  if (out.change.part == Part::kJoint)
    back = moved(last.state, out.change.parameters, -last.change.segment(last.begin[k], count));
  out.motion_m = motion_of(own, last.state, back);
  out.alternatives = alternatives_to(judge, search, k, own, tolerance_m);
  return out;
}

/// Changes that matter but that these readings could not have shown. Those that were refitted on
/// purpose hide the joints next to them.
std::vector<Visibility> blind_spots(const Search& search, const Readings& readings,
                                    const ArmState& extended, const Measurements& own,
                                    const Assumed& assumed, int joints, double limit_m) {
  Eigen::MatrixXd S = search.nothing().S;
  std::vector<Change> asked;
  for (const auto& change : search.possible()) {
    const bool placed = (assumed.new_frame && change.joint == 0) ||
                        (assumed.new_target && change.joint == joints - 1);
    const bool wanted = change.part == Part::kTool || change.part == Part::kBase ||
                        (change.part == Part::kJoint && change.effect == "offset");
    if (wanted && !placed) asked.push_back(change);
  }
  if (search.assumed() > 0) {
    const auto& B = search.nothing().B;
    S += 1e2 * B * B.transpose();  // anything that frame or target can make of it is no evidence
  }
  auto out = visibility(asked, readings.rows, own, extended, S);
  std::erase_if(out, [&](const Visibility& v) { return v.unseen_m <= limit_m; });
  return out;
}

/// If a change of a joint and one of tool or base move the measured point alike, the numbers of the
/// measurement are refitted and the arm stays as it is known; the joint is reported as not
/// excluded.
void prefer_placing(const Judge& judge, const Measurements& own, double tolerance_m,
                    Search& search) {
  for (std::size_t k = search.assumed(); k < search.found().size(); ++k) {
    if (search.found()[k].part != Part::kJoint) continue;
    for (const auto& other : alternatives_to(judge, search, k, own, tolerance_m)) {
      const bool placing = other.change.part == Part::kTool || other.change.part == Part::kBase;
      if (!placing || other.behind_nats >= kUndecided || other.matters) continue;
      search.replace(k, other.change);
      break;
    }
  }
}

/// The orientations that are left once the changes found are in the state.
TurnCheck turns_after(const Run& calibrated, const Search& search, const Readings& readings,
                      const std::vector<int>& odd) {
  std::vector<int> rows;
  for (int i = 0; i < readings.rows.size(); ++i)
    if (std::find(odd.begin(), odd.end(), i) == odd.end()) rows.push_back(i);
  const bool placed = std::any_of(search.found().begin(), search.found().end(),
                                  [](const Change& c) { return c.part == Part::kTool; });
  return check_turns(calibrated, search.last().state, pick(readings.rows, rows), readings.poses,
                     placed);
}

/// The changes that a new run can keep: assumed ones, single readings, and those that were decided.
std::vector<Change> kept_changes(const Search& search, const std::vector<FoundChange>& found) {
  std::vector<Change> out = search.found();
  for (const auto& one : found)
    if (undecided(one)) std::erase_if(out, [&](const Change& c) { return same(c, one.change); });
  return out;
}

}  // namespace

Recheck recheck_run(const Cell& cell, const Run& calibrated, const Run& run,
                    const Measurements& own, Measurements rows, const Assumed& assumed) {
  LastSetup setup = last_setup(run);
  place_at_the_end(own, rows);
  const Readings readings = expect_readings(cell, calibrated, own, std::move(rows));
  setup.known =
      with_series(std::move(setup.known), setup.state, calibrated, own, readings.sigma_m());
  const ArmState extended = with_room_for_changes(cell, own, readings.rows, setup.state);
  const Measurements poses = poses_of(own, calibrated);
  std::vector<Change> possible = possible_changes(cell, extended, poses, readings.poses);
  std::vector<Change> always = assumed_changes(assumed, possible);
  const Judge judge(readings, extended, setup.known);
  Search search(judge, readings, std::move(possible), std::move(always));
  search.run();
  prefer_placing(judge, poses, cell.tolerance_m, search);

  Recheck out;
  out.readings = readings.rows.size();
  out.poses = readings.poses;
  out.then = usual_held(run.fit);
  for (std::size_t k = search.assumed(); k < search.found().size(); ++k)
    if (search.found()[k].part == Part::kReading)
      out.odd_readings.push_back(search.found()[k].row);
    else
      out.found.push_back(described(judge, search, k, extended, poses, cell.tolerance_m));
  std::sort(out.found.begin(), out.found.end(),
            [](const FoundChange& a, const FoundChange& b) { return a.ln_bayes > b.ln_bayes; });

  const Judged& last = search.last();
  const double lines = static_cast<double>(last.r.size());
  out.excess = std::sqrt(last.chi2 / lines);
  out.something_else = ln_chance_of(last.chi2, lines) < std::log(kTooMuch);
  out.elsewhere = readings.elsewhere;
  out.only_elsewhere = out.found.empty() && !out.something_else && last.lacks_elsewhere;
  const double axes = static_cast<double>(readings.axes);
  out.limit_m = std::max(cell.tolerance_m, 2.0 * std::sqrt(axes) * readings.sigma_m());
  out.blind = blind_spots(search, readings, extended, poses, assumed, cell.joints(), out.limit_m);
  // Mean length of a normally distributed vector with `axes` components and the expected
  // covariance.
  const double mean_of_unit =
      std::sqrt(2.0) * std::exp(std::lgamma(0.5 * (axes + 1.0)) - std::lgamma(0.5 * axes));
  const Judged& nothing = search.nothing();
  out.expected_m = mean_of_unit *
                   std::sqrt((nothing.S.diagonal().array() + nothing.mean.array().square()).mean());
  out.control_m = out.expected_m *
                  (1.0 + 3.0 * std::sqrt((axes / (mean_of_unit * mean_of_unit) - 1.0) / out.poses));

  const std::vector<Change> only_assumed(
      search.found().begin(), search.found().begin() + static_cast<long>(search.assumed()));
  out.before =
      stats_of(left_out_errors(readings, only_assumed, search.nothing()), out.odd_readings);
  out.turns = turns_after(calibrated, search, readings, out.odd_readings);
  const bool open = std::any_of(out.found.begin(), out.found.end(), undecided);
  const std::vector<Change> kept = kept_changes(search, out.found);
  const Judged refit = open ? judge.judge(kept) : last;
  out.keeps = !open || std::any_of(out.found.begin(), out.found.end(), std::not_fn(undecided));
  const Rows3 left = left_out_errors(readings, kept, refit);
  out.after = stats_of(left, out.odd_readings);
  out.fitted = stats_of(errors_of(readings, refit.r + refit.mean - refit.B * refit.change),
                        out.odd_readings);
  out.predicted_M = readings.rows.p_M - left;
  out.calibration = refitted(cell, run.fit.calibration, setup, kept, refit);
  const bool as_before = out.found.empty() && !out.something_else && !out.turns.turned();
  if (open || (out.only_elsewhere && !out.turns.turned()) || (as_before && !out.blind.empty()))
    out.verdict = Recheck::Verdict::kUndecidable;
  else if (as_before)
    out.verdict = Recheck::Verdict::kTrue;
  else
    out.verdict = Recheck::Verdict::kChanged;
  return out;
}

}  // namespace plumb::offline::recheck
