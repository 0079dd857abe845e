// SPDX-License-Identifier: Apache-2.0
#include "diagnose/candidates.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnose/confounding.hpp"
#include "diagnose/extension.hpp"
#include "diagnose/held_out.hpp"
#include "diagnose/plausible.hpp"
#include "fit/effect_binding.hpp"
#include "plumb/runtime/effect_library.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kListed = 12;
constexpr std::size_t kCompared = 8;  // for confounding
constexpr double kConfounded = 0.8;   // mutual reproduction

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

std::vector<CandidateNumber> numbers_of(const Stage& s, const Judge& judge, const Block& block,
                                        const Trial& trial, const std::vector<double>& cycles) {
  format::Model model;
  model.calibrated = s.cell->nominal;
  model.effects = {bind_effect(*s.cell, *s.measured, block.entry)};
  Eigen::MatrixXd gram = trial.folds.front().XX;
  Eigen::MatrixXd UX = trial.folds.front().UX;
  for (std::size_t f = 1; f < trial.folds.size(); ++f) {
    gram += trial.folds[f].XX;
    UX += trial.folds[f].UX;
  }
  gram -= UX.transpose() * UX;
  const double left =
      std::max(judge.scale().variance, s.Q * (1.0 - trial.explained) / judge.scale().lines);
  gram.diagonal().array() += left / std::pow(trial.evidence.width, 2);
  const Eigen::MatrixXd C =
      left * gram.ldlt().solve(Eigen::MatrixXd::Identity(gram.rows(), gram.cols()));
  std::vector<CandidateNumber> out;
  for (Eigen::Index c = 0; c < trial.theta.size(); ++c) {
    const int member = block.members[c];
    if (!cycles.empty()) model.effects[0].constants = {cycles[static_cast<std::size_t>(c / 2)]};
    const EffectParameter& info = effect_parameter(model, 0, member);
    const double value = trial.theta(c) * block.typical(c);
    const double std = std::sqrt(std::max(0.0, C(c, c))) * block.typical(c);
    out.push_back({effect_parameter_name(model, 0, member), info.unit, value, std, info.typical,
                   plausible(value, std, info)});
  }
  return out;
}

Candidate candidate(const Stage& s, const Judge& judge, const Found& found) {
  const EffectInfo& info = effect_info(find_effect_law(found.entry.name));
  const Block block = block_of(s, found);
  Candidate out;
  out.entry = found.entry;
  out.title = info.title;
  out.domain = word(info.domain);
  out.ln_bayes = found.ln_bayes();
  const Gain gain = judge.gain(found.trial);
  out.gain = gain.share;
  out.gain_se = gain.share_se;
  out.cycles = found.cycles;
  if (out.cycles.empty())
    if (const auto it = found.entry.options.find("cycles_per_turn");
        it != found.entry.options.end())
      out.cycles = {std::get<double>(it->second)};
  out.supported = found.score > kSupported && gain.clear;
  out.numbers = numbers_of(s, judge, block, found.trial, found.cycles);
  out.plausible = std::all_of(out.numbers.begin(), out.numbers.end(),
                              [](const CandidateNumber& n) { return n.plausible; });
  out.explained = found.trial.explained;
  out.absorbed = found.trial.absorbed;
  out.alone = held_out_error(judge, block, found.trial);
  return out;
}

/// Whether one lists a joint of the other.
bool overlap(const EffectEntry& a, const EffectEntry& b) {
  return std::any_of(a.joints.begin(), a.joints.end(), [&](int joint) {
    return std::find(b.joints.begin(), b.joints.end(), joint) != b.joints.end();
  });
}

void name_confounded(const Stage& s, const std::vector<const Found*>& found,
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
void add_after(const Stage& s, const std::vector<const Found*>& found,
               std::vector<Candidate>& out) {
  const Stage next = extended(s, block_of(s, *found.front()));
  const Judge judge(next);
  out.front().after = out.front().alone;
  for (std::size_t i = 1; i < found.size(); ++i) {
    const Block block = block_of(next, *found[i]);
    out[i].after = held_out_error(judge, block, judge.judge(block));
  }
}

}  // namespace

std::vector<Candidate> candidates_of(const Stage& stage, const Scan& scan) {
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
  const Judge judge(stage);
  for (const Found* f : found) out.push_back(candidate(stage, judge, *f));
  name_confounded(stage, found, out);
  add_after(stage, found, out);
  return out;
}

UnknownStructure unknown_structure(const Stage& s, const Found& found) {
  UnknownStructure out;
  out.pattern = found.pattern;
  out.share = found.trial.explained;
  const double lines = static_cast<double>(std::max<Eigen::Index>(1, s.fit_poses()));
  out.rms_m = std::sqrt(std::max(0.0, found.trial.explained) * s.Q / lines) * s.sigma_m;
  out.rms_rad = found.rms_joint;
  return out;
}

}  // namespace plumb::offline
