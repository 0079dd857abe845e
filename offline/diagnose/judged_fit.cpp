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

/// Scatter of which `lines` tell, and how much better it explains them than noise alone.
Repeatability scatter_seen(const WhitenedFit& whitened, const ScatterLines& lines,
                           const JointScatter& scatter) {
  Repeatability out = repeatability_of(whitened, scatter);
  out.ln_bayes = nats_over(lines, scatter, noise_alone(lines));
  return out;
}

}  // namespace

JudgedFit judged(WhitenedFit whitened, const std::vector<std::string>& not_testable,
                 const std::vector<std::string>& banned) {
  JudgedFit out;
  out.look = scan(whitened, not_testable, banned);
  const ScatterLines lines = scatter_lines(whitened);
  const JointScatter null = noise_and_scatter(lines);
  out.repeatability = scatter_seen(whitened, lines, null);
  const Found* beside = best_of(out.look);
  if (beside == nullptr || out.repeatability.ln_bayes < kScatterMatters) {
    out.whitened = std::move(whitened);
    return out;
  }
  for (int round = 0; round < kScatterRounds && beside != nullptr; ++round) {
    const std::string name = name_of(whitened, *beside);
    const ScatterLines with =
        scatter_lines(whitened, over_fit_lines(whitened, columns_of(whitened, *beside)));
    const JointScatter left = noise_and_scatter(with);
    const double nats = nats_over(lines, null, left);
    out.repeatability = scatter_seen(whitened, with, left);
    if (left.none() && round == 0) {
      whitened.scatter_nats = nats;
      pay(out.look, nats);
      out.whitened = std::move(whitened);
      return out;
    }
    out.whitened = with_scatter(whitened, left);
    out.whitened.scatter_nats = nats;
    out.look = scan(out.whitened, not_testable, banned);
    beside = best_of(out.look);
    if (beside != nullptr && name_of(whitened, *beside) == name) break;
  }
  // Where nothing holds its own, scatter explains it all.
  if (beside == nullptr) out.repeatability = scatter_seen(whitened, lines, null);
  return out;
}

}  // namespace plumb::offline
