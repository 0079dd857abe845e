// SPDX-License-Identifier: Apache-2.0
#include "diagnose/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnose/constants.hpp"
#include "noise/usual_errors.hpp"

namespace plumb::offline {
namespace {

/// Calls visit(reading, whitened lines, lines in m and rad) for each pose.
template <class Visit>
void visit_errors(const WhitenedFit& s, const Segment& at, const Eigen::VectorXd& lines,
                  const Visit& visit) {
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const Eigen::Index pose = at.begin + i;
    const Eigen::VectorXd white = lines.segment(s.table.count(at.begin, pose), s.table.count(pose));
    Eigen::VectorXd error = white;
    unwhiten(s, pose, error);
    visit(s.reading[static_cast<std::size_t>(pose)], white, error);
  }
}

/// Errors of each pose: of its point [m] and, where it is measured, of its orientation [rad].
struct Norms {
  std::vector<double> points_m, turns_rad;

  void add(const WhitenedFit& s, const Segment& at, const Eigen::VectorXd& lines) {
    visit_errors(s, at, lines,
                 [&](const Reading& reading, const Eigen::VectorXd&, const Eigen::VectorXd& error) {
                   points_m.push_back(error.head(reading.point_lines()).norm());
                   if (s.turns()) turns_rad.push_back(error.tail(reading.turn_lines()).norm());
                 });
  }

  HeldOutError usual(const WhitenedFit& s) && {
    HeldOutError out{usual_errors(std::move(points_m), s.measured->usual_axes(), s.sigma_m), {}};
    if (s.turns()) out.turns = summarise(std::move(turns_rad));
    return out;
  }
};

double sum_of_squares(const std::vector<double>& norms) {
  double out = 0.0;
  for (const double norm : norms) out += norm * norm;
  return out;
}

/// Sum of the squared errors of all poses: that of the points [m^2], and each orientation counts as
/// a point that misses by as many sigmas.
double squared_error(const WhitenedFit& s, const Segment& at, const Eigen::VectorXd& lines) {
  double out = 0.0;
  visit_errors(
      s, at, lines,
      [&](const Reading& reading, const Eigen::VectorXd& white, const Eigen::VectorXd& error) {
        const double point = error.head(reading.point_lines()).norm();
        out += point * point;
        if (s.turns())
          out += std::pow(s.sigma_m, 2) * white.tail(reading.turn_lines()).squaredNorm();
      });
  return out;
}

auto lines_of(const WhitenedFit& s, const Segment& at) {
  return Eigen::seqN(s.table.begin(at.begin), s.table.count(at.begin, at.end));
}

/// Whitened lines of a fold as the others predict them: without the regressor, and with it.
Eigen::VectorXd left_in_fold(const Scorer& scorer, std::size_t f) {
  const WhitenedFit& s = scorer.whitened();
  const auto at = lines_of(s, s.folds[f]);
  return s.y(at) - s.U(at, Eigen::all) * scorer.without(f).model;
}

Eigen::VectorXd left_in_fold(const Scorer& scorer, std::size_t f,
                             const CandidateInFolds& candidate) {
  const WhitenedFit& s = scorer.whitened();
  const RegressorScore& scored = candidate.scored[f];
  if (scored.theta.size() == 0) return left_in_fold(scorer, f);
  const auto at = lines_of(s, s.folds[f]);
  const auto fitted = scorer.without(f, scored);
  return s.y(at) - s.U(at, Eigen::all) * fitted.model -
         motion(s, candidate.regressor[f], fitted.regressor)(at);
}

}  // namespace

HeldOutError held_out_error(const Scorer& scorer) {
  const WhitenedFit& s = scorer.whitened();
  Norms norms;
  if (s.held.size() > 0) {
    norms.add(s, s.held, s.y(lines_of(s, s.held)));
    return std::move(norms).usual(s);
  }
  norms.points_m = s.contradicted_m;
  for (std::size_t f = 0; f < s.folds.size(); ++f)
    norms.add(s, s.folds[f], left_in_fold(scorer, f));
  return std::move(norms).usual(s);
}

HeldOutError held_out_error(const Scorer& scorer, const Regressor& regressor,
                            const RegressorScore& scored, const CandidateInFolds& in_folds) {
  const WhitenedFit& s = scorer.whitened();
  Norms norms;
  if (s.held.size() > 0) {
    const auto at = lines_of(s, s.held);
    const Eigen::VectorXd moved = motion(s, regressor, scored.theta);
    const Eigen::VectorXd a = -(s.U.topRows(s.fit_lines).transpose() * moved.head(s.fit_lines));
    norms.add(s, s.held, s.y(at) - s.U(at, Eigen::all) * a - moved(at));
    return std::move(norms).usual(s);
  }
  norms.points_m = s.contradicted_m;
  for (std::size_t f = 0; f < s.folds.size(); ++f)
    norms.add(s, s.folds[f], left_in_fold(scorer, f, in_folds));
  return std::move(norms).usual(s);
}

Gain held_out_gain(const Scorer& scorer, const CandidateInFolds& in_folds) {
  const WhitenedFit& s = scorer.whitened();
  std::vector<double> before, after;
  for (std::size_t f = 0; f < s.folds.size(); ++f) {
    before.push_back(squared_error(s, s.folds[f], left_in_fold(scorer, f)));
    after.push_back(squared_error(s, s.folds[f], left_in_fold(scorer, f, in_folds)));
  }
  return gain_of(before, after);
}

bool shown_by_points_or_turns(const Scorer& scorer, const Regressor& regressor,
                              const RegressorScore& scored) {
  const WhitenedFit& s = scorer.whitened();
  const std::size_t count = s.folds.size();
  const CandidateInFolds same{std::vector<Regressor>(count, regressor),
                              std::vector<RegressorScore>(count, scored)};
  std::vector<double> points_before, points_after, turns_before, turns_after;
  for (std::size_t f = 0; f < count; ++f) {
    Norms without, with;
    without.add(s, s.folds[f], left_in_fold(scorer, f));
    with.add(s, s.folds[f], left_in_fold(scorer, f, same));
    points_before.push_back(sum_of_squares(without.points_m));
    points_after.push_back(sum_of_squares(with.points_m));
    turns_before.push_back(sum_of_squares(without.turns_rad));
    turns_after.push_back(sum_of_squares(with.turns_rad));
  }
  const Gain points = gain_of(points_before, points_after);
  if (points.standard_errors < -kSpeaksAgainst) return false;
  return points.standard_errors > 1.0 ||
         gain_of(turns_before, turns_after).share > 1.0 - kTurnsFall;
}

}  // namespace plumb::offline
