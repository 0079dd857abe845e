// SPDX-License-Identifier: Apache-2.0
#include "diagnose/held_out.hpp"

#include "noise/usual_errors.hpp"

namespace plumb::offline {
namespace {

/// 3-D error of each pose of whitened lines.
void add_norms(const WhitenedFit& s, const Segment& at, const Eigen::VectorXd& lines,
               std::vector<double>& out) {
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    Eigen::VectorXd error = lines.segment(s.table.begin(i), s.table.count(i));
    unwhiten(s, at.begin + i, error);
    out.push_back(error.norm());
  }
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

double sum_of_squares(const std::vector<double>& norms) {
  double out = 0.0;
  for (const double norm : norms) out += norm * norm;
  return out;
}

}  // namespace

ErrorStats held_out_error(const Scorer& scorer) {
  const WhitenedFit& s = scorer.whitened();
  std::vector<double> norms;
  if (s.held.size() > 0) {
    add_norms(s, s.held, s.y(lines_of(s, s.held)), norms);
    return usual_errors(std::move(norms), s.table.most(), s.sigma_m);
  }
  norms = s.contradicted_m;
  for (std::size_t f = 0; f < s.folds.size(); ++f)
    add_norms(s, s.folds[f], left_in_fold(scorer, f), norms);
  return usual_errors(std::move(norms), s.table.most(), s.sigma_m);
}

ErrorStats held_out_error(const Scorer& scorer, const Regressor& regressor,
                          const RegressorScore& scored, const CandidateInFolds& in_folds) {
  const WhitenedFit& s = scorer.whitened();
  std::vector<double> norms;
  if (s.held.size() > 0) {
    const auto at = lines_of(s, s.held);
    const Eigen::VectorXd moved = motion(s, regressor, scored.theta);
    const Eigen::VectorXd a = -(s.U.topRows(s.fit_lines).transpose() * moved.head(s.fit_lines));
    add_norms(s, s.held, s.y(at) - s.U(at, Eigen::all) * a - moved(at), norms);
    return usual_errors(std::move(norms), s.table.most(), s.sigma_m);
  }
  norms = s.contradicted_m;
  for (std::size_t f = 0; f < s.folds.size(); ++f)
    add_norms(s, s.folds[f], left_in_fold(scorer, f, in_folds), norms);
  return usual_errors(std::move(norms), s.table.most(), s.sigma_m);
}

Gain held_out_gain(const Scorer& scorer, const CandidateInFolds& in_folds) {
  const WhitenedFit& s = scorer.whitened();
  std::vector<double> before, after;
  for (std::size_t f = 0; f < s.folds.size(); ++f) {
    std::vector<double> without, with;
    add_norms(s, s.folds[f], left_in_fold(scorer, f), without);
    add_norms(s, s.folds[f], left_in_fold(scorer, f, in_folds), with);
    before.push_back(sum_of_squares(without));
    after.push_back(sum_of_squares(with));
  }
  return gain_of(before, after);
}

}  // namespace plumb::offline
