// SPDX-License-Identifier: Apache-2.0
#include "diagnose/judged_fit.hpp"

#include <algorithm>

#include "diagnose/constants.hpp"
#include "diagnose/extension.hpp"
#include "diagnose/scattered_fit.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

const Found* best_of(const Scan& look) {
  if (look.unknown()) return &*look.pattern;
  return look.supported();
}

/// The columns of a candidate, shape (lines, b). A pattern is looked for among all of them.
Eigen::MatrixXd columns_of(const WhitenedFit& whitened, const Found& found) {
  if (found.pattern.empty()) return motions(whitened, regressor_of(whitened, found));
  Eigen::MatrixXd out;
  visit_patterns(whitened, [&](const Regressor& regressor) {
    if (regressor.pattern.subject == found.pattern.subject &&
        regressor.pattern.words == found.pattern.words)
      out = motions(whitened, regressor);
  });
  return out;
}

Eigen::MatrixXd over_fit_lines(const WhitenedFit& s, Eigen::MatrixXd columns) {
  return columns.topRows(s.fit_lines);
}

/// The lines from which the scatter of the joints beside a candidate is estimated. Of a series the
/// fitted motion is subtracted instead of projecting out its columns: these are so many that only
/// their prior limits what they explain.
ScatterLines lines_beside(const WhitenedFit& s, const Found& found) {
  if (found.pattern.empty() && is_series(found.entry.name))
    return scatter_lines(extended(s, regressor_of(s, found), found.scored.theta));
  return scatter_lines(s, over_fit_lines(s, columns_of(s, found)));
}

std::string name_of(const WhitenedFit& s, const Found& found) {
  return found.pattern.empty() ? key_of(*s.cell, found.entry)
                               : found.pattern.subject + found.pattern.words;
}

/// How much better `a` explains the lines than `b` [nats]; each variance of a joint costs one.
double nats_over(const ScatterLines& lines, const JointScatter& a, const JointScatter& b) {
  const auto cost = [](const JointScatter& at) {
    return static_cast<double>((at.variance.array() > 0.0).count());
  };
  return ln_likelihood_of_ratios(lines, a) - ln_likelihood_of_ratios(lines, b) - cost(a) + cost(b);
}

void pay(Scan& look, double nats) {
  const auto pays = [nats](Found& found) {
    found.scored.evidence.ln_bayes -= nats;
    found.score -= nats;
  };
  std::for_each(look.library.begin(), look.library.end(), pays);
  if (look.pattern) pays(*look.pattern);
  if (look.slow) pays(*look.slow);
}

Repeatability scatter_seen(const WhitenedFit& whitened, const ScatterLines& lines,
                           const JointScatter& scatter) {
  Repeatability out = repeatability_of(whitened, scatter);
  out.nats = nats_over(lines, scatter, noise_alone(lines));
  return out;
}

/// The score of the best candidate, where one is supported.
double score_of(const Scan& look) {
  const Found* best = best_of(look);
  return best == nullptr ? kImpossible : best->score;
}

/// The fit whitened by the scatter that is left beside a candidate, and scanned again.
JudgedFit scattered(const WhitenedFit& whitened, const ScatterLines& lines,
                    const JointScatter& null, const Found& beside,
                    const std::vector<std::string>& not_testable,
                    const std::vector<std::string>& banned) {
  const ScatterLines with = lines_beside(whitened, beside);
  const JointScatter left = noise_and_scatter(with);
  JudgedFit out;
  out.repeatability = scatter_seen(whitened, with, left);
  out.whitened = with_scatter(whitened, left);
  out.whitened.scatter_nats = std::max(0.0, nats_over(lines, null, left));
  out.look = scan(out.whitened, not_testable, banned);
  return out;
}

}  // namespace

double scatter_nats(const WhitenedFit& whitened) {
  const ScatterLines lines = scatter_lines(whitened);
  return std::max(0.0, nats_over(lines, noise_and_scatter(lines), noise_alone(lines)));
}

JudgedFit judged(WhitenedFit whitened, const std::vector<std::string>& not_testable,
                 const std::vector<std::string>& banned) {
  JudgedFit out;
  out.look = scan(whitened, not_testable, banned);
  const ScatterLines lines = scatter_lines(whitened);
  const JointScatter noise = noise_alone(lines), null = noise_and_scatter(lines);
  const Repeatability alone = scatter_seen(whitened, lines, null);
  const Found* beside = best_of(out.look);
  if (beside == nullptr || alone.nats < kScatterMatters) {
    out.whitened = std::move(whitened);
    out.repeatability = alone;
    return out;
  }
  // Three explanations: the best candidate and noise; the best candidate and scatter; scatter.
  const WhitenedFit white = whitened;
  const Scan first = out.look;
  whitened.scatter_nats = std::max(0.0, nats_over(lines, null, noise));
  pay(out.look, whitened.scatter_nats);
  out.repeatability = repeatability_of(white, noise);
  out.whitened = std::move(whitened);
  std::string name;
  beside = best_of(first);
  JudgedFit next;
  for (int round = 0; round < kScatterRounds && beside != nullptr; ++round) {
    if (name_of(white, *beside) == name) break;
    name = name_of(white, *beside);
    next = scattered(white, lines, null, *beside, not_testable, banned);
    if (score_of(next.look) > score_of(out.look)) out = next;
    beside = best_of(next.look);
  }
  if (best_of(out.look) != nullptr) return out;
  // No candidate is supported beside the scatter, so scatter alone explains the residual.
  out = std::move(next);
  out.repeatability = alone;
  return out;
}

}  // namespace plumb::offline
