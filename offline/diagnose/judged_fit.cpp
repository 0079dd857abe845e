// SPDX-License-Identifier: Apache-2.0
#include "diagnose/judged_fit.hpp"

#include <algorithm>

#include "diagnose/constants.hpp"
#include "diagnose/scattered_fit.hpp"

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

std::string name_of(const WhitenedFit& s, const Found& found) {
  return found.pattern.empty() ? key_of(*s.cell, found.entry)
                               : found.pattern.subject + found.pattern.words;
}

/// How much better `a` explains the residual than `b`, without any effect [nats].
double nats_over(const ScatterLines& lines, const JointScatter& a, const JointScatter& b) {
  const ScatterLines some = thinned(lines, kScatterPoses);
  const double nats = ln_likelihood_of_ratios(some, a) - ln_likelihood_of_ratios(some, b);
  return std::max(0.0, nats) * static_cast<double>(lines.poses()) /
         static_cast<double>(std::max<Eigen::Index>(1, some.poses()));
}

void pay(Scan& look, double nats) {
  const auto pays = [nats](Found& found) {
    found.scored.evidence.ln_bayes -= nats;
    found.score -= nats;
  };
  std::for_each(look.library.begin(), look.library.end(), pays);
  if (look.pattern) pays(*look.pattern);
}

}  // namespace

JudgedFit judged(WhitenedFit whitened, const std::vector<std::string>& not_testable,
                 const std::vector<std::string>& banned) {
  Scan look = scan(whitened, not_testable, banned);
  const Found* best = best_of(look);
  if (best == nullptr) return {std::move(whitened), std::move(look)};
  const ScatterLines lines = scatter_lines(whitened);
  const JointScatter noise = noise_alone(lines), null = noise_and_scatter(lines);
  if (nats_over(lines, null, noise) < kScatterMatters)
    return {std::move(whitened), std::move(look)};
  JudgedFit out;
  std::string name = name_of(whitened, *best);
  const Found* beside = best;
  for (int round = 0; round < kScatterRounds; ++round) {
    const JointScatter left = noise_and_scatter(
        scatter_lines(whitened, over_fit_lines(whitened, columns_of(whitened, *beside))));
    const double nats = nats_over(lines, null, left);
    if (left.none() && round == 0) {
      whitened.scatter_nats = nats;
      pay(look, nats);
      return {std::move(whitened), std::move(look)};
    }
    out.whitened = with_scatter(whitened, left);
    out.whitened.scatter_nats = nats;
    out.look = scan(out.whitened, not_testable, banned);
    beside = best_of(out.look);
    if (beside == nullptr || name_of(whitened, *beside) == name) break;
    name = name_of(whitened, *beside);
  }
  return out;
}

}  // namespace plumb::offline
