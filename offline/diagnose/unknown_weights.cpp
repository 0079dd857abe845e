// SPDX-License-Identifier: Apache-2.0
#include "diagnose/unknown_weights.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>

#include "diagnose/constants.hpp"
#include "diagnose/evidence.hpp"
#include "diagnose/evidence_scale.hpp"
#include "diagnose/regressor_score.hpp"
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

/// Laws whose error depends on the pose alone. The deformation of an arm of unknown weights may
/// look like any of them.
bool depends_on_pose_alone(const EffectDescriptor& effect) {
  return effect.law != nullptr && !is_wave(effect.name) && !is_series(effect.name) &&
         (effect.law->needs & ~(kNeedsMasses | kNeedsTracker)) == 0;
}

/// Laws by which something else than a joint yields to its load. They are linear in the loads.
bool yields_beside_joints(const EffectDescriptor& effect) {
  return effect.law != nullptr && (effect.law->needs & kNeedsMasses) != 0 &&
         !effect.turns_listed_joint_only;
}

std::vector<EffectEntry> laws_beside_joints(const WhitenedFit& s) {
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

/// A law under the loads that are known and under every weight of the links, each column as large
/// as a typical effect. Shape (lines, columns that move anything).
Eigen::MatrixXd under_any_weights(const WhitenedFit& s, const EffectEntry& entry) {
  constexpr int kLoadsOfLink = 4;
  std::vector<Eigen::VectorXd> motions{motion_under(s, entry, s.loads)};
  for (int link = 0; link < s.joints(); ++link)
    for (int k = 0; k < kLoadsOfLink; ++k)
      motions.push_back(motion_under(s, entry, loads_of_link(s, link, k - 1)));
  double largest = 0.0;
  for (const auto& motion : motions) largest = std::max(largest, motion.norm());
  std::erase_if(motions, [&](const auto& m) { return !(m.norm() > kMovesNothing * largest); });
  const double typical = kTypicalMotion_m / s.sigma_m *
                         std::sqrt(static_cast<double>(std::max<Eigen::Index>(1, s.poses())));
  Eigen::MatrixXd out(s.fit_lines, static_cast<Eigen::Index>(motions.size()));
  for (std::size_t c = 0; c < motions.size(); ++c)
    out.col(static_cast<Eigen::Index>(c)) =
        motions[c].head(s.fit_lines) * (typical / motions[c].norm());
  return out;
}

EffectEntry yielding(int joint) {
  return {.name = std::string(effects::JointCompliance::kInfo.name),
          .joints = {joint},
          .options = {},
          .place = {}};
}

/// The evidence of several laws together, each under any weights.
class Together {
 public:
  Together(const WhitenedFit& s, const std::vector<EffectEntry>& laws) : s_(s) {
    std::vector<Eigen::MatrixXd> parts;
    Eigen::Index columns = 0;
    for (const EffectEntry& law : laws) {
      parts.push_back(under_any_weights(s, law));
      first_.push_back(columns);
      columns += parts.back().cols();
    }
    first_.push_back(columns);
    Eigen::MatrixXd X(s.fit_lines, columns);
    for (std::size_t i = 0; i < parts.size(); ++i)
      X.middleCols(first_[i], parts[i].cols()) = parts[i];
    const auto U = s.U.topRows(s.fit_lines);
    X -= U * (U.transpose() * X).eval();
    gram_ = X.transpose() * X;
    v_ = X.transpose() * s.y.head(s.fit_lines);
  }

  bool moves_anything(std::size_t law) const { return first_[law + 1] > first_[law]; }

  double ln_bayes(const std::vector<std::size_t>& laws) const {
    std::vector<Eigen::Index> at;
    for (const std::size_t law : laws)
      for (Eigen::Index c = first_[law]; c < first_[law + 1]; ++c) at.push_back(c);
    return evidence(gram_(at, at), v_(at), s_.Q, evidence_scale(s_)).ln_bayes - s_.scatter_nats;
  }

 private:
  const WhitenedFit& s_;
  std::vector<Eigen::Index> first_;  // column of each law; then their number
  Eigen::MatrixXd gram_;
  Eigen::VectorXd v_;
};

/// The columns of a candidate at other poses than those at which it was found.
Regressor regressor_there(const WhitenedFit& s, const Found& found) {
  if (found.pattern.empty()) return regressor_of(s, found);
  Regressor out;
  visit_patterns(s, [&](const Regressor& one) {
    if (one.pattern.subject == found.pattern.subject && one.pattern.words == found.pattern.words)
      out = one;
  });
  return out;
}

/// Explanations by laws that do not belong to joints: each law alone; and where several joints
/// yield, also two such laws together, or one such law and one joint.
std::vector<std::vector<std::size_t>> explanations(const Together& all, std::size_t joints,
                                                   std::size_t laws, bool in_pairs) {
  std::vector<std::vector<std::size_t>> out;
  for (std::size_t law = joints; law < joints + laws; ++law) {
    if (!all.moves_anything(law)) continue;
    out.push_back({law});
    for (std::size_t other = 0; in_pairs && other < law; ++other)
      if (all.moves_anything(other)) out.push_back({law, other});
  }
  return out;
}

}  // namespace

std::vector<Found> rivals_under_unknown_weights(const WhitenedFit& whitened, const Found& first) {
  std::vector<Found> out;
  const bool by_name = first.pattern.empty();
  if (!states_no_mass(*whitened.cell) ||
      (by_name ? !depends_on_pose_alone(descriptor_of(first.entry.name)) : first.pattern.slow))
    return out;
  const bool turned = by_name && gravity_turns_joint(descriptor_of(first.entry.name));
  const WhitenedFit s = thinned(whitened, std::min(whitened.fit_poses(), kComparedPoses));
  std::vector<EffectEntry> laws;
  if (turned)
    for (const int joint : first.entry.joints) laws.push_back(yielding(joint));
  const std::size_t joints = laws.size();
  for (const EffectEntry& law : laws_beside_joints(s))
    if (law.name != first.entry.name) laws.push_back(law);
  const Together all(s, laws);
  const Regressor regressor = regressor_there(s, first);
  double own = regressor.columns.cols() > 0 ? Scorer(s).score(regressor).evidence.ln_bayes : 0.0;
  if (turned) {
    // As the candidate it is, or under any weights and the known payload, as its rivals are.
    std::vector<std::size_t> places(joints);
    std::iota(places.begin(), places.end(), std::size_t{0});
    own = std::max(own, all.ln_bayes(places));
  }
  double best = own;
  for (const auto& places : explanations(all, joints, laws.size() - joints, joints > 1)) {
    const double ln_bayes = all.ln_bayes(places);
    best = std::max(best, ln_bayes);
    // Two laws of so many weights describe joints that yield nearly as well as these do.
    if (ln_bayes < own && places.size() > 1) continue;
    for (const std::size_t place : places) {
      if (place < joints) continue;
      out.push_back({laws[place], {}, {}, {}, 0.0, {}, 0.0});
      out.back().scored.evidence.ln_bayes = ln_bayes;
    }
  }
  std::erase_if(out, [best](const Found& found) { return found.ln_bayes() < best - kTold_nats; });
  std::stable_sort(out.begin(), out.end(),
                   [](const Found& a, const Found& b) { return a.ln_bayes() > b.ln_bayes(); });
  std::set<std::string> names;
  std::erase_if(out, [&](const Found& found) { return !names.insert(found.entry.name).second; });
  for (Found& found : out) found.scored.evidence.ln_bayes += first.ln_bayes() - own;
  return out;
}

}  // namespace plumb::offline
