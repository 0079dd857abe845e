// SPDX-License-Identifier: Apache-2.0
#include "diagnose/candidates.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnose/confounding.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/extension.hpp"
#include "diagnose/held_out.hpp"
#include "diagnose/plausible.hpp"
#include "effects/effect_option.hpp"
#include "effects/registry.hpp"
#include "fit/effect_binding.hpp"

namespace plumb::offline {
namespace {

const char* word(EffectDomain domain) {
  switch (domain) {
    case EffectDomain::kRobot:
      return "robot";
    case EffectDomain::kEnvironment:
      return "environment";
    case EffectDomain::kProcedure:
      return "procedure";
    default:
      return "measurement";
  }
}

std::vector<CandidateNumber> numbers_of(const WhitenedFit& s, const Regressor& regressor,
                                        const RegressorScore& scored,
                                        const std::vector<double>& cycles) {
  format::Model model;
  model.calibrated = s.cell->nominal;
  model.effects = {bind_effect(*s.cell, *s.measured, regressor.entry)};
  Eigen::MatrixXd gram = scored.folds.front().XX;
  Eigen::MatrixXd UX = scored.folds.front().UX;
  for (std::size_t f = 1; f < scored.folds.size(); ++f) {
    gram += scored.folds[f].XX;
    UX += scored.folds[f].UX;
  }
  gram -= UX.transpose() * UX;
  const double left = scored.variance;
  gram.diagonal().array() += left / std::pow(scored.evidence.width, 2);
  const Eigen::MatrixXd C =
      left * gram.ldlt().solve(Eigen::MatrixXd::Identity(gram.rows(), gram.cols()));
  std::vector<CandidateNumber> out;
  for (Eigen::Index c = 0; c < scored.theta.size(); ++c) {
    const int member = regressor.members[c];
    if (!cycles.empty()) model.effects[0].constants = {cycles[static_cast<std::size_t>(c / 2)]};
    const EffectParameter& info = effect_parameter(model, 0, member);
    const double value = scored.theta(c) * regressor.typical(c);
    const double std = std::sqrt(std::max(0.0, C(c, c))) * regressor.typical(c);
    out.push_back({effect_parameter_name(model, 0, member), info.unit, value, std, info.typical,
                   plausible(value, std, info)});
  }
  return out;
}

/// Largest motion of the measured point at the fit poses, cleared of what the model can imitate
/// [m].
double largest_motion(const WhitenedFit& s, const Regressor& regressor,
                      const RegressorScore& scored) {
  Eigen::VectorXd motion = motions(s, regressor).topRows(s.fit_lines) * scored.theta;
  const auto U = s.U.topRows(s.fit_lines);
  motion -= U * (U.transpose() * motion).eval();
  for (Eigen::Index i = 0; i < s.fit_poses(); ++i)
    unwhiten(s, i, motion.segment(i * s.axes, s.axes));
  return motion.reshaped(s.axes, s.fit_poses()).colwise().norm().maxCoeff();
}

Candidate candidate(const WhitenedFit& s, const Scorer& scorer, const Found& found) {
  const EffectInfo& info = *descriptor_of(found.entry.name).law;
  const Regressor regressor = regressor_of(s, found);
  Candidate out;
  out.entry = found.entry;
  out.title = info.title;
  out.domain = word(info.domain);
  out.ln_bayes = found.ln_bayes();
  const Gain gain = scorer.gain(found.scored);
  out.gain = gain.share;
  out.gain_se = gain.share_se;
  out.cycles = found.cycles;
  if (out.cycles.empty() && has_option(found.entry, OptionKey::kCyclesPerTurn))
    out.cycles = {number_option(found.entry, OptionKey::kCyclesPerTurn, 0.0)};
  out.supported = found.score > kSupported && gain.clear;
  out.numbers = numbers_of(s, regressor, found.scored, found.cycles);
  out.plausible = std::all_of(out.numbers.begin(), out.numbers.end(),
                              [](const CandidateNumber& n) { return n.plausible; });
  out.explained = found.scored.explained;
  out.absorbed = found.scored.absorbed;
  out.largest_m = largest_motion(s, regressor, found.scored);
  out.alone = held_out_error(scorer, regressor, found.scored);
  return out;
}

/// Whether one lists a joint of the other.
bool overlap(const EffectEntry& a, const EffectEntry& b) {
  return std::any_of(a.joints.begin(), a.joints.end(), [&](int joint) {
    return std::find(b.joints.begin(), b.joints.end(), joint) != b.joints.end();
  });
}

void name_confounded(const WhitenedFit& s, const std::vector<const Found*>& found,
                     std::vector<Candidate>& out) {
  const std::vector<const Found*> some(found.begin(),
                                       found.begin() + std::min(found.size(), kCompared));
  const Eigen::MatrixXd share = reproduction(s, some);
  for (std::size_t i = 0; i < some.size(); ++i) {
    for (std::size_t k = 0; k < some.size(); ++k) {
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(k);
      if (i == k || std::min(share(a, b), share(b, a)) < kConfounded) continue;
      if (some[i]->entry.name == some[k]->entry.name && overlap(some[i]->entry, some[k]->entry))
        continue;
      out[i].confounded_with.push_back(key_of(*s.cell, some[k]->entry));
      if (out[i].rival) continue;
      out[i].rival = some[k]->entry;
      out[i].separate = separating_measurement(some[i]->entry, some[k]->entry);
    }
    for (auto& name : disguises(some[i]->entry)) out[i].confounded_with.push_back(name);
  }
}

/// Held-out error of each with the best one already in.
void add_after(const WhitenedFit& s, const std::vector<const Found*>& found,
               std::vector<Candidate>& out) {
  const WhitenedFit next = extended(s, regressor_of(s, *found.front()));
  const Scorer scorer(next);
  out.front().after = out.front().alone;
  for (std::size_t i = 1; i < found.size(); ++i) {
    const Regressor regressor = regressor_of(next, *found[i]);
    out[i].after = held_out_error(scorer, regressor, scorer.score(regressor));
  }
}

}  // namespace

std::vector<Candidate> candidates_of(const WhitenedFit& whitened, const Scan& scan) {
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
  const Scorer scorer(whitened);
  for (const Found* f : found) out.push_back(candidate(whitened, scorer, *f));
  name_confounded(whitened, found, out);
  add_after(whitened, found, out);
  return out;
}

UnknownStructure unknown_structure(const WhitenedFit& s, const Found& found) {
  UnknownStructure out;
  out.pattern = found.pattern;
  out.share = found.scored.explained;
  const double lines = static_cast<double>(std::max<Eigen::Index>(1, s.fit_poses()));
  out.rms_m = std::sqrt(std::max(0.0, found.scored.explained) * s.Q / lines) * s.sigma_m;
  out.rms_rad = found.rms_joint;
  return out;
}

}  // namespace plumb::offline
