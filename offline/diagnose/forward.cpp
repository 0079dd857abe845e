// SPDX-License-Identifier: Apache-2.0
#include "diagnose/forward.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>

#include "diagnose/candidates.hpp"
#include "diagnose/effect_list.hpp"
#include "fit/effect_binding.hpp"
#include "plumb/runtime/effect_library.hpp"

namespace plumb::offline {
namespace {

constexpr int kMostSteps = 60;
constexpr double kRemainder = 0.15;  // of the motion of the strongest effect in the model

/// Columns of one effect at one joint among the fitted parameters.
struct Part {
  EffectEntry entry;
  std::vector<Eigen::Index> index;
};

/// The parts of the effects that were added, each as it was added.
std::vector<Part> parts_of(const Cell& cell, const Calibration& calibration) {
  std::map<std::pair<int, int>, Part> found;
  const auto& effects = calibration.state.arm.effects;
  std::vector<const EffectEntry*> entries;
  for (const auto& entry : cell.effects)
    if (find_effect_law(entry.name) >= 0) entries.push_back(&entry);
  for (std::size_t i = 0; i < calibration.parameters.size(); ++i) {
    const Parameter& p = calibration.parameters[i];
    if (!p.of_effect()) continue;
    const auto& effect = effects[p.joint];
    const EffectInfo& info = effect_info(find_effect_law(effect.name));
    const bool apart = info.per_joint && effect.name != "thermal_growth" && !effect.joints.empty();
    const int each = static_cast<int>(effect.parameters.size() / std::max<std::size_t>(1, effect.joints.size()));
    const int at = apart && effect.name != "gravity_free" ? p.component / std::max(1, each) : -1;
    Part& part = found[{p.joint, at}];
    part.entry = *entries[p.joint];
    if (at >= 0) part.entry.joints = {effect.joints[at]};
    part.index.push_back(static_cast<Eigen::Index>(i));
  }
  std::vector<Part> out;
  for (auto& [key, part] : found) out.push_back(std::move(part));
  return out;
}

/// Evidence of a part over all else in the model, from the joint fit alone.
double evidence_of(const Part& part, const Stage& stage, const Calibration& calibration) {
  const auto b = static_cast<Eigen::Index>(part.index.size());
  Eigen::VectorXd theta(b);
  for (Eigen::Index i = 0; i < b; ++i) {
    const Parameter& p = calibration.parameters[part.index[i]];
    double typical = effect_parameter(calibration.state.arm, p.joint, p.component).typical;
    const double value = value_of(calibration.state, p);
    if (typical == 0.0) typical = std::max(std::abs(value), 1e-300);
    theta(i) = value / typical;
  }
  Eigen::MatrixXd C = stage.inverse_information(part.index, part.index);
  for (Eigen::Index i = 0; i < b; ++i) {
    const Parameter& p = calibration.parameters[part.index[i]];
    double typical = effect_parameter(calibration.state.arm, p.joint, p.component).typical;
    if (typical == 0.0) typical = std::max(std::abs(value_of(calibration.state, p)), 1e-300);
    C.row(i) /= typical;
    C.col(i) /= typical;
  }
  const Eigen::MatrixXd gram = C.ldlt().solve(Eigen::MatrixXd::Identity(b, b));
  const Eigen::VectorXd v = gram * theta;
  EvidenceScale scale = Judge(stage).scale();
  scale.lines += static_cast<double>(b);
  return evidence(gram, v, stage.Q + theta.dot(v), scale).ln_bayes;
}

/// RMS motion of a part that nothing else in the model could make, whitened.
double motion_of(const Part& part, const Stage& stage, const Calibration& calibration) {
  Eigen::VectorXd theta(static_cast<Eigen::Index>(part.index.size()));
  for (Eigen::Index i = 0; i < theta.size(); ++i)
    theta(i) = value_of(calibration.state, calibration.parameters[part.index[i]]);
  const Eigen::MatrixXd C = stage.inverse_information(part.index, part.index);
  return std::sqrt(std::max(0.0, theta.dot(C.ldlt().solve(theta))));
}

/// Whether a candidate is small enough to be what the law of a stronger effect in the model leaves:
/// no law is right to more than some percent. Waves of other lengths are other causes.
bool is_remainder(const Cell& cell, const Stage& stage, const Calibration& calibration,
                  const Found& found) {
  double largest = 0.0;
  for (const auto& part : parts_of(cell, calibration))
    if (part.entry.name != "gear_ripple" || found.entry.name != "gear_ripple")
      largest = std::max(largest, motion_of(part, stage, calibration));
  return std::sqrt(std::max(0.0, found.trial.explained) * stage.Q) < kRemainder * largest;
}

std::string words(const Cell& cell, const EffectEntry& entry) { return key_of(cell, entry); }

/// The part that lost its evidence, if one did; what was just added stays.
std::optional<EffectEntry> lost(const Cell& cell, const Stage& stage,
                                const Calibration& calibration,
                                const std::vector<EffectEntry>& given, const EffectEntry& fresh) {
  std::optional<EffectEntry> out;
  double least = kSupported;
  for (const auto& part : parts_of(cell, calibration)) {
    if (has_effect(given, part.entry)) continue;  // the user's own
    if (part.entry.name == fresh.name && part.entry.joints == fresh.joints) continue;
    const double ln = evidence_of(part, stage, calibration);
    if (ln >= least) continue;
    least = ln;
    out = part.entry;
  }
  return out;
}

}  // namespace

std::vector<int> without_outliers(std::vector<int> rows, const Calibration& calibration) {
  for (const auto& outlier : calibration.outliers) std::erase(rows, outlier.row);
  return rows;
}

Calibration refitted(const Cell& cell, const Measurements& measured, const std::vector<int>& fit,
                     const std::vector<EffectEntry>& effects, const Calibration& from) {
  Cell with = cell;
  with.effects = effects;
  ArmState start = from.state;
  start.arm.effects = bind_effects(with, measured);
  return calibrate_from(with, measured, fit, start);
}

Forward forward(const ForwardStart& start, const Calibration& calibration, Stage stage,
                const Scan& first) {
  Forward out;
  Cell cell = start.cell;
  Calibration now = calibration;
  Scan look = first;
  std::vector<std::string> banned;
  for (int step = 0; step < kMostSteps; ++step) {
    if (look.unknown()) {
      out.unknown = unknown_structure(stage, *look.pattern);
      break;
    }
    const Found* best = look.supported([&](const Found& found) {
      return !is_remainder(cell, stage, now, found);
    });
    if (best == nullptr) break;
    if (start.tell) start.tell(words(cell, best->entry));
    auto effects = with_effect(cell.effects, best->entry);
    try {
      Calibration next = refitted(start.cell, start.measured, start.fit, effects, now);
      Cell with = start.cell;
      with.effects = effects;
      const auto rows = without_outliers(start.fit, next);
      stage = make_stage(with, start.measured, next, rows, {});
      if (const auto weak = lost(with, stage, next, start.cell.effects, best->entry)) {
        banned.push_back(key_of(cell, *weak));
        effects = without_effect(effects, *weak);
        with.effects = effects;
        next = refitted(start.cell, start.measured, start.fit, effects, next);
        stage = make_stage(with, start.measured, next, without_outliers(start.fit, next), {});
      }
      cell = with;
      stage.cell = &cell;
      now = next;
      out.steps.push_back({best->entry, best->ln_bayes(), effects, next});
      look = scan(stage, start.not_testable, banned);
    } catch (const Failure&) {
      // An effect that cannot be fitted jointly is none that these poses support.
      banned.push_back(key_of(cell, best->entry));
      const auto rows = without_outliers(start.fit, now);
      stage = make_stage(cell, start.measured, now, rows, {});
      look = scan(stage, start.not_testable, banned);
    }
  }
  return out;
}

}  // namespace plumb::offline
