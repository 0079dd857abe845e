// SPDX-License-Identifier: Apache-2.0
#include "diagnose/unknown_weights.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "diagnose/constants.hpp"
#include "diagnose/thinned_fit.hpp"
#include "effects/registry.hpp"
#include "plumb/runtime/detail/effects/gravity_compensator.hpp"
#include "plumb/runtime/detail/effects/joint_compliance.hpp"

namespace plumb::offline {
namespace {

constexpr double kMovesNothing = 1e-9;  // of a column, over the largest

bool states_no_mass(const Cell& cell) {
  return std::none_of(cell.mechanics.begin(), cell.mechanics.end(),
                      [](const JointMechanics& joint) { return joint.has_mass(); });
}

/// Laws by which gravity turns a joint: it yields, or a spring that carries it is not what it
/// should be.
bool gravity_turns_joint(const EffectDescriptor& effect) {
  return effect.cause == Cause::kYieldingJoint ||
         effect.name == effects::GravityCompensator::kInfo.name;
}

/// Laws by which something else than a joint yields to its load. They are linear in the loads.
bool yields_beside_joints(const EffectDescriptor& effect) {
  return effect.law != nullptr && (effect.law->needs & kNeedsMasses) != 0 &&
         !effect.turns_listed_joint_only;
}

std::vector<EffectEntry> laws_of(const WhitenedFit& s) {
  std::vector<EffectEntry> out;
  for (const EffectDescriptor* effect : effect_descriptors()) {
    if (!yields_beside_joints(*effect)) continue;
    EffectEntry entry{.name = std::string(effect->name), .joints = {}, .options = {}, .place = {}};
    if (effect->candidate_joints == CandidateJoints::kNone) out.push_back(entry);
    for (int j = 0; j < s.joints() && effect->candidate_joints == CandidateJoints::kEach; ++j) {
      entry.joints = {j};
      out.push_back(entry);
    }
  }
  return out;
}

/// The loads of one link alone: 1 kg at the origin of its frame (axis < 0), or a first moment of
/// 1 kg m along one of its axes.
std::vector<Loads> loads_of_link(const WhitenedFit& s, int link, int axis) {
  const Vector3 zero(0.0, 0.0, 0.0);
  std::vector<Loads> out = s.loads;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Transformd& frame = s.frames[i].joint[link];
    const Loads::Behind alone =
        axis < 0 ? Loads::Behind{frame.p, 1.0} : Loads::Behind{Vector3(frame.R.col(axis)), 0.0};
    for (int j = 0; j < s.joints(); ++j)
      out[i].joint[j] = j <= link ? alone : Loads::Behind{zero, 0.0};
    out[i].payload_force = zero;
    out[i].payload_kg = 0.0;
    out[i].pushed = false;
  }
  return out;
}

/// The motion of the law per unit of its compliance, the same in all directions. Parameters that
/// may be negative only say in which direction it is softer.
Eigen::VectorXd motion_under(const WhitenedFit& s, const EffectEntry& entry,
                             const std::vector<Loads>& loads) {
  const Eigen::MatrixXd motions = motions_under(s, entry, loads);
  const auto parameters = descriptor_of(entry.name).law->parameters;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(motions.rows());
  for (Eigen::Index c = 0; c < motions.cols(); ++c)
    if (parameters[static_cast<std::size_t>(c)].low >= 0.0) out += motions.col(c);
  return out;
}

/// A law at these places, under the loads that are known and under every weight of the links, each
/// column as large as a typical effect.
Regressor under_any_weights(const WhitenedFit& s, const std::vector<EffectEntry>& places) {
  constexpr int kLoadsOfLink = 4;
  std::vector<Eigen::VectorXd> motions;
  for (const EffectEntry& entry : places) {
    motions.push_back(motion_under(s, entry, s.loads));
    for (int link = 0; link < s.joints(); ++link)
      for (int k = 0; k < kLoadsOfLink; ++k)
        motions.push_back(motion_under(s, entry, loads_of_link(s, link, k - 1)));
  }
  double largest = 0.0;
  for (const auto& motion : motions) largest = std::max(largest, motion.norm());
  std::erase_if(motions, [&](const auto& m) { return !(m.norm() > kMovesNothing * largest); });
  const double typical = kTypicalMotion_m / s.sigma_m *
                         std::sqrt(static_cast<double>(std::max<Eigen::Index>(1, s.poses())));
  Regressor out;
  out.entry = places.front();
  const auto count = static_cast<Eigen::Index>(motions.size());
  out.typical.resize(count);
  out.columns.resize(s.poses() * s.axes, count);
  for (Eigen::Index c = 0; c < count; ++c) {
    const Eigen::VectorXd& motion = motions[static_cast<std::size_t>(c)];
    out.typical(c) = typical / motion.norm();
    out.columns.col(c) = motion * out.typical(c);
  }
  return out;
}

/// The evidence of a joint that yields: as the candidate it is, or under any weights and the
/// payload's known one together, as its rivals have them.
double evidence_of_joints(const WhitenedFit& s, const Scorer& scorer, const Found& first) {
  std::vector<EffectEntry> places;
  for (const int joint : first.entry.joints)
    places.push_back({.name = std::string(effects::JointCompliance::kInfo.name),
                      .joints = {joint},
                      .options = {},
                      .place = {}});
  return std::max(scorer.score(regressor_of(s, first)).evidence.ln_bayes,
                  scorer.score(under_any_weights(s, places)).evidence.ln_bayes);
}

}  // namespace

std::vector<Found> rivals_under_unknown_weights(const WhitenedFit& whitened, const Found& first) {
  std::vector<Found> out;
  if (!gravity_turns_joint(descriptor_of(first.entry.name)) || !states_no_mass(*whitened.cell))
    return out;
  const WhitenedFit s = thinned(whitened, std::min(whitened.fit_poses(), kComparedPoses));
  const Scorer scorer(s);
  const double own = evidence_of_joints(s, scorer, first);
  double best = own;
  for (const EffectEntry& entry : laws_of(s)) {
    const Regressor regressor = under_any_weights(s, {entry});
    if (regressor.columns.cols() == 0) continue;
    out.push_back({entry, {}, scorer.score(regressor), {}, 0.0, {}, 0.0});
    best = std::max(best, out.back().ln_bayes());
  }
  std::erase_if(out, [best](const Found& found) { return found.ln_bayes() < best - kTold_nats; });
  std::sort(out.begin(), out.end(),
            [](const Found& a, const Found& b) { return a.ln_bayes() > b.ln_bayes(); });
  std::set<std::string> laws;
  std::erase_if(out, [&](const Found& found) { return !laws.insert(found.entry.name).second; });
  for (Found& found : out) found.scored.evidence.ln_bayes += first.ln_bayes() - own;
  return out;
}

}  // namespace plumb::offline
