// SPDX-License-Identifier: Apache-2.0
#include "diagnose/candidates.hpp"

#include "diagnose/alternatives.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "arm/effect_binding.hpp"
#include "diagnose/confounding.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/effect_domain.hpp"
#include "diagnose/extension.hpp"
#include "diagnose/fitted_size.hpp"
#include "diagnose/held_out.hpp"
#include "diagnose/ripple_scan.hpp"
#include "diagnose/series_scan.hpp"
#include "diagnose/thinned_fit.hpp"
#include "effects/effect_option.hpp"
#include "effects/registry.hpp"
#include "fit/plausible.hpp"

namespace plumb::offline {
namespace {

/// A candidate as a model that holds it alone, to ask for the names and bounds of its numbers.
format::Model model_of(const WhitenedFit& s, const Regressor& regressor) {
  format::Model out;
  out.calibrated = s.cell->nominal;
  out.effects = {bind_effect(*s.cell, *s.measured, regressor.entry)};
  return out;
}

/// The columns whose sizes are listed: all, but of a series only its largest waves.
std::vector<Eigen::Index> numbers_told(const Regressor& regressor, const Eigen::VectorXd& theta) {
  std::vector<Eigen::Index> out(static_cast<std::size_t>(theta.size()));
  std::iota(out.begin(), out.end(), Eigen::Index{0});
  if (!is_series(regressor.entry.name)) return out;
  const auto size = [&](Eigen::Index c) {
    const Eigen::Index k = c / 2 * 2;
    return std::hypot(theta(k) * regressor.typical(k), theta(k + 1) * regressor.typical(k + 1));
  };
  std::stable_sort(out.begin(), out.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return size(a) > size(b); });
  out.resize(std::min(out.size(), 2 * kPeaksListed));
  return out;
}

/// The prior of a fit of each column, in units of its typical size; 0 where there is none.
Eigen::VectorXd fit_prior(const format::Model& model, const Regressor& regressor) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(regressor.typical.size());
  const double width = descriptor_of(regressor.entry.name).prior_width;
  for (Eigen::Index c = 0; c < out.size(); ++c) {
    const auto place = static_cast<std::size_t>(c);
    const double typical = effect_parameter(model, 0, regressor.members[place]).typical;
    if (regressor.typical(c) != 0.0) out(c) = width * typical / std::abs(regressor.typical(c));
  }
  return out;
}

std::vector<CandidateNumber> numbers_of(format::Model model, const Regressor& regressor,
                                        const FittedSize& size, const std::vector<double>& cycles) {
  std::vector<CandidateNumber> out;
  for (const Eigen::Index c : numbers_told(regressor, size.theta)) {
    const int member = regressor.members[static_cast<std::size_t>(c)];
    if (!cycles.empty()) model.effects[0].constants = {cycles[static_cast<std::size_t>(c / 2)]};
    if (!regressor.after_rows.empty())
      model.effects[0].constants.front() = regressor.after_rows[static_cast<std::size_t>(c)] - 0.5;
    EffectParameter info = effect_parameter(model, 0, member);
    // The bound on the size of one wave is the same whatever the slope of the spectrum is.
    if (is_series(regressor.entry.name))
      info.typical = descriptor_of(regressor.entry.name).law->parameters.front().typical;
    const double value = size.theta(c) * regressor.typical(c);
    const double std = size.std(c) * std::abs(regressor.typical(c));
    out.push_back({effect_parameter_name(model, 0, member), info.unit, value, std, info.typical,
                   plausible(value, std, info)});
  }
  return out;
}

/// Largest motion of the measured point at the fit poses [m], less the part that parameters of the
/// model can imitate.
double largest_motion(const WhitenedFit& s, const Regressor& regressor,
                      const Eigen::VectorXd& theta) {
  Eigen::VectorXd moved = motion(s, regressor, theta).head(s.fit_lines);
  const auto U = s.U.topRows(s.fit_lines);
  moved -= U * (U.transpose() * moved).eval();
  for (Eigen::Index i = 0; i < s.fit_poses(); ++i)
    unwhiten(s, i, moved.segment(s.table.begin(i), s.table.count(i)));
  double out = 0.0;
  for (Eigen::Index i = 0; i < s.fit_poses(); ++i)
    out = std::max(out, moved(s.point_lines(i)).norm());
  return out;
}

/// The candidate as reported: the effect, its numbers and its evidence; errors are still empty.
Candidate described(const WhitenedFit& s, const Found& found) {
  const EffectInfo& info = *descriptor_of(found.entry.name).law;
  const Regressor regressor = regressor_of(s, found);
  Candidate out;
  out.entry = found.entry;
  out.title = info.title;
  out.domain = domain_word(found.entry);
  out.ln_bayes = found.ln_bayes();
  out.cycles = found.cycles;
  if (out.cycles.empty() && has_option(found.entry, OptionKey::kCyclesPerTurn))
    out.cycles = {number_option(found.entry, OptionKey::kCyclesPerTurn, 0.0)};
  out.supported = found.score > kSupported && found.gain.clear;
  out.peaks = found.peaks;
  out.moves = found.moves;
  const format::Model model = model_of(s, regressor);
  const FittedSize size = fitted_size(found.scored, fit_prior(model, regressor),
                                      descriptor_of(found.entry.name).prior_tail);
  out.numbers = numbers_of(model, regressor, size, found.cycles);
  out.plausible = std::all_of(out.numbers.begin(), out.numbers.end(),
                              [](const CandidateNumber& n) { return n.plausible; });
  out.explained = found.scored.explained;
  out.absorbed = found.scored.absorbed;
  out.largest_m = largest_motion(s, regressor, size.theta);
  return out;
}

/// The candidate scored at another fit than the one whose scan found it.
RegressorScore score_of(const Scorer& scorer, const Found& found, const Regressor& regressor) {
  return is_series(found.entry.name) ? score_series(scorer, found.entry) : scorer.score(regressor);
}

CandidateInFolds in_folds(const Scorer& scorer, const Found& found, const Regressor& regressor,
                          const RegressorScore& scored, double regressors) {
  CandidateInFolds out;
  const std::size_t folds = scorer.whitened().folds.size();
  if (!is_wave(found.entry.name)) {
    out.regressor.assign(folds, regressor);
    out.scored.assign(folds, scored);
    return out;
  }
  const int joint = found.entry.joints.front();
  const auto waves = waves_without_folds(scorer, joint, found.cycles, regressors);
  out.scored = scored_without_folds(scorer, joint, waves);
  for (const auto& cycles : waves)
    out.regressor.push_back(cycles.empty() ? Regressor{}
                                           : ripple_regressor(scorer.whitened(), joint, cycles));
  return out;
}

/// Held-out error of a candidate alone.
void add_alone(const WhitenedFit& plain, const Scorer& scorer, const Found& found,
               double regressors, Candidate& out) {
  const Regressor regressor = regressor_of(plain, found);
  const RegressorScore scored = score_of(scorer, found, regressor);
  const CandidateInFolds folds = in_folds(scorer, found, regressor, scored, regressors);
  const Gain gain = held_out_gain(scorer, folds);
  out.gain = gain.share;
  out.gain_se = gain.share_se;
  const HeldOutError held = held_out_error(scorer, regressor, scored, folds);
  out.alone = held.points;
  out.alone_turns = held.turns;
}

/// RMS over the fit poses of the fitted motion of the joint that a pattern belongs to; 0 if the
/// pattern belongs to no joint.
double joint_rms(const WhitenedFit& s, const Pattern& pattern) {
  double out = 0.0;
  const Scorer scorer(s);
  visit_patterns(s, [&](const Regressor& regressor) {
    if (regressor.joint < 0 || regressor.pattern.subject != pattern.subject ||
        regressor.pattern.words != pattern.words)
      return;
    const double width = descriptor_of(wave_effect()).prior_width;  // as of any error of a joint
    const FittedSize size = fitted_size(scorer.score(regressor),
                                        Eigen::VectorXd::Constant(regressor.columns.cols(), width));
    const Eigen::VectorXd angle = regressor.columns.topRows(s.fit_poses()) * size.theta;
    out = std::sqrt(angle.squaredNorm() / static_cast<double>(angle.size()));
  });
  return out;
}

/// Whether the two have a joint in common.
bool overlap(const EffectEntry& a, const EffectEntry& b) {
  return std::any_of(a.joints.begin(), a.joints.end(), [&](int joint) {
    return std::find(b.joints.begin(), b.joints.end(), joint) != b.joints.end();
  });
}

void name_confounded(const WhitenedFit& s, const std::vector<const Found*>& found,
                     std::vector<Candidate>& out) {
  const std::vector<const Found*> some(found.begin(),
                                       found.begin() + std::min(found.size(), kCompared));
  const bool many_columns = std::any_of(some.begin(), some.end(),
                                        [](const Found* f) { return is_series(f->entry.name); });
  const Eigen::MatrixXd share = many_columns && s.fit_poses() > kComparedPoses
                                    ? reproduction(thinned(s, kComparedPoses), some)
                                    : reproduction(s, some);
  for (std::size_t i = 0; i < some.size(); ++i) {
    for (std::size_t k = 0; k < some.size(); ++k) {
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(k);
      if (i == k || std::min(share(a, b), share(b, a)) < kConfounded) continue;
      if (some[i]->entry.name == some[k]->entry.name && overlap(some[i]->entry, some[k]->entry))
        continue;
      out[i].confounded_with.push_back(key_of(*s.cell, some[k]->entry));
      if (!out[i].separate.empty()) continue;
      out[i].separate = separating_measurement(some[i]->entry, some[k]->entry);
    }
    for (auto& name : disguises(some[i]->entry)) out[i].confounded_with.push_back(name);
  }
}

/// The held-out error of each candidate if the best one is already in the model.
void add_after(const WhitenedFit& plain, const Scorer& alone,
               const std::vector<const Found*>& found, double regressors,
               std::vector<Candidate>& out) {
  const Regressor best = regressor_of(plain, *found.front());
  const WhitenedFit next = extended(plain, best, score_of(alone, *found.front(), best).theta);
  const Scorer scorer(next);
  out.front().after = out.front().alone;
  for (std::size_t i = 1; i < found.size(); ++i) {
    const Regressor regressor = regressor_of(next, *found[i]);
    const RegressorScore scored = score_of(scorer, *found[i], regressor);
    out[i].after = held_out_error(scorer, regressor, scored,
                                  in_folds(scorer, *found[i], regressor, scored, regressors))
                       .points;
  }
}

}  // namespace

std::vector<Candidate> candidates_of(const WhitenedFit& whitened, const WhitenedFit& plain,
                                     const Scan& scan) {
  std::vector<const Found*> found;
  const Found* best = scan.supported();
  if (best != nullptr) found.push_back(best);
  for (const auto& f : scan.library) {
    if (&f == best) continue;
    if (found.size() >= kListed && !(f.score > kSupported && f.gain.clear)) continue;
    found.push_back(&f);
  }
  std::vector<Candidate> out;
  if (found.empty()) return out;
  const Scorer plain_scorer(plain);
  for (const Found* f : found) {
    out.push_back(described(whitened, *f));
    add_alone(plain, plain_scorer, *f, scan.regressors, out.back());
  }
  name_confounded(whitened, found, out);
  add_after(plain, plain_scorer, found, scan.regressors, out);
  return out;
}

UnknownStructure unknown_structure(const WhitenedFit& s, const Found& found) {
  UnknownStructure out;
  out.pattern = found.pattern;
  out.share = found.scored.explained;
  const double lines = static_cast<double>(std::max<Eigen::Index>(1, s.fit_poses()));
  out.rms_m = std::sqrt(std::max(0.0, found.scored.explained) * s.Q / lines) * s.sigma_m;
  out.rms_rad = joint_rms(s, found.pattern);
  out.alternatives = alternatives_under_unknown_weights(s, found);
  return out;
}

}  // namespace plumb::offline
