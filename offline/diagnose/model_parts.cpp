// SPDX-License-Identifier: Apache-2.0
#include "diagnose/model_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/evidence_scale.hpp"
#include "effects/registry.hpp"
#include "fit/fit_judgement.hpp"
#include "fit/plausible.hpp"
#include "numbers/cholesky.hpp"

namespace plumb::offline {
namespace {

/// Columns of one effect at one joint among the fitted parameters.
struct EffectColumns {
  EffectEntry entry;
  std::vector<Eigen::Index> index;
};

/// The parts of the effects that were added, each as it was added.
std::vector<EffectColumns> parts_of(const Cell& cell, const Calibration& calibration) {
  std::map<std::pair<int, int>, EffectColumns> found;
  const auto& effects = calibration.state.arm.effects;
  std::vector<const EffectEntry*> entries;
  for (const auto& entry : cell.effects)
    if (descriptor_of(entry.name).law != nullptr) entries.push_back(&entry);
  for (std::size_t i = 0; i < calibration.parameters.size(); ++i) {
    const Parameter& p = calibration.parameters[i];
    if (!p.of_effect()) continue;
    const auto& effect = effects[p.joint];
    const bool apart = descriptor_of(effect.name).joints_apart && !effect.joints.empty();
    const int each =
        static_cast<int>(effect.parameters.size() / std::max<std::size_t>(1, effect.joints.size()));
    const int at = apart ? p.component / std::max(1, each) : -1;
    EffectColumns& part = found[{p.joint, at}];
    part.entry = *entries[p.joint];
    if (at >= 0) part.entry.joints = {effect.joints[at]};
    part.index.push_back(static_cast<Eigen::Index>(i));
  }
  std::vector<EffectColumns> out;
  for (auto& [key, part] : found) out.push_back(std::move(part));
  return out;
}

/// Inverse information of a part's parameters, those of the rest being unknown.
Eigen::MatrixXd covariance_of(const EffectColumns& part, const WhitenedFit& whitened) {
  const Eigen::MatrixXd half = whitened.half_information(part.index, Eigen::all);
  return half * half.transpose();
}

/// Evidence for a part beside all other parts of the model, from the common fit alone.
double evidence_of(const EffectColumns& part, const WhitenedFit& whitened,
                   const Calibration& calibration) {
  const auto b = static_cast<Eigen::Index>(part.index.size());
  Eigen::VectorXd theta(b);
  for (Eigen::Index i = 0; i < b; ++i) {
    const Parameter& p = calibration.parameters[part.index[i]];
    double typical = effect_parameter(calibration.state.arm, p.joint, p.component).typical;
    const double value = value_of(calibration.state, p);
    if (typical == 0.0) typical = std::max(std::abs(value), 1e-300);
    theta(i) = (value + whitened.correction(part.index[i])) / typical;
  }
  Eigen::MatrixXd C = covariance_of(part, whitened);
  for (Eigen::Index i = 0; i < b; ++i) {
    const Parameter& p = calibration.parameters[part.index[i]];
    double typical = effect_parameter(calibration.state.arm, p.joint, p.component).typical;
    if (typical == 0.0) typical = std::max(std::abs(value_of(calibration.state, p)), 1e-300);
    C.row(i) /= typical;
    C.col(i) /= typical;
  }
  const Eigen::MatrixXd gram = SymmetricSolver(C).inverse();
  const Eigen::VectorXd v = gram * theta;
  EvidenceScale scale = evidence_scale(whitened);
  scale.lines += static_cast<double>(b);
  return evidence(gram, v, whitened.Q + theta.dot(v), scale).ln_bayes;
}

/// RMS whitened motion of a part that no other parameters of the model can reproduce.
double motion_of(const EffectColumns& part, const WhitenedFit& whitened,
                 const Calibration& calibration) {
  Eigen::VectorXd theta(static_cast<Eigen::Index>(part.index.size()));
  for (Eigen::Index i = 0; i < theta.size(); ++i)
    theta(i) = value_of(calibration.state, calibration.parameters[part.index[i]]);
  const Eigen::MatrixXd C = covariance_of(part, whitened);
  return std::sqrt(std::max(0.0, theta.dot(SymmetricSolver(C).solve(theta))));
}

/// A pattern of no law has a cause of its own.
Cause cause_of(const EffectEntry& entry) {
  const EffectDescriptor* effect = find_descriptor(entry.name);
  return effect != nullptr ? effect->cause : Cause::kItsOwn;
}

/// Whether one effect is a finer law of the same cause: a spring that is not linear, a gear whose
/// error is not a pure wave.
bool refines(const EffectEntry& a, const EffectEntry& b) {
  return cause_of(a) != Cause::kItsOwn && cause_of(a) == cause_of(b) && a.joints == b.joints;
}

}  // namespace

bool is_remainder(const Cell& cell, const WhitenedFit& whitened, const Calibration& calibration,
                  const Found& found) {
  if (reaches_noise(whitened, found.scored)) return false;
  double largest = 0.0;
  for (const auto& part : parts_of(cell, calibration))
    if ((!is_wave(part.entry.name) || !is_wave(found.entry.name)) &&
        !refines(part.entry, found.entry))
      largest = std::max(largest, motion_of(part, whitened, calibration));
  return std::sqrt(std::max(0.0, found.scored.explained) * whitened.Q) < kRemainder * largest;
}

std::optional<EffectEntry> lost(const Cell& cell, const WhitenedFit& whitened,
                                const Calibration& calibration,
                                const std::vector<EffectEntry>& given, const EffectEntry& fresh) {
  std::optional<EffectEntry> out;
  double least = kSupported;
  for (const auto& part : parts_of(cell, calibration)) {
    if (has_effect(given, part.entry)) continue;  // the user's own
    if (part.entry.name == fresh.name && part.entry.joints == fresh.joints) continue;
    const double ln = evidence_of(part, whitened, calibration);
    if (ln >= least) continue;
    least = ln;
    out = part.entry;
  }
  return out;
}

std::vector<Oversized> oversized(const Cell& cell, const WhitenedFit& whitened,
                                 const Calibration& calibration,
                                 const std::vector<EffectEntry>& given) {
  std::vector<Oversized> out;
  const double s = std::sqrt(whitened.noise.variance);
  for (const auto& part : parts_of(cell, calibration)) {
    if (has_effect(given, part.entry)) continue;
    Oversized one{.entry = part.entry};
    bool fine = true;
    for (const Eigen::Index i : part.index) {
      const Parameter& p = calibration.parameters[static_cast<std::size_t>(i)];
      const auto info = effect_parameter(calibration.state.arm, p.joint, p.component);
      const double value = value_of(calibration.state, p);
      const double std =
          s * std::sqrt(std::max(0.0, whitened.half_information.row(i).squaredNorm()));
      fine = fine && plausible(value, std, info);
      one.possible = one.possible && possible(value, std, info);
      one.times = std::max(one.times, times_usual(value, std, info));
    }
    if (!fine) out.push_back(std::move(one));
  }
  std::sort(out.begin(), out.end(), [](const Oversized& a, const Oversized& b) {
    return a.possible != b.possible ? b.possible : a.times > b.times;
  });
  return out;
}

}  // namespace plumb::offline
