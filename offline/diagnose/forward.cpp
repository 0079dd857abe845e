// SPDX-License-Identifier: Apache-2.0
#include "diagnose/forward.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <set>

#include "diagnose/candidates.hpp"
#include "diagnose/effect_list.hpp"
#include "fit/effect_binding.hpp"
#include "plumb/runtime/effect_library.hpp"

namespace plumb::offline {
namespace {

constexpr int kMostSteps = 60;
constexpr std::size_t kMostExchanges = 4;
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
    const int each =
        static_cast<int>(effect.parameters.size() / std::max<std::size_t>(1, effect.joints.size()));
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

/// Whether one effect is a finer law of the same cause: a spring that is not linear, a gear whose
/// error is not a pure wave.
bool refines(const EffectEntry& a, const EffectEntry& b) {
  const auto kind = [](const std::string& name) {
    if (name == "joint_compliance" || name == "joint_compliance_soft" || name == "gravity_free")
      return 1;
    if (name == "gear_ripple" || name == "gear_harmonics" || name == "joint_table") return 2;
    return 0;
  };
  return kind(a.name) != 0 && kind(a.name) == kind(b.name) && a.joints == b.joints;
}

/// Whether a candidate is small enough to be what the law of a stronger effect in the model leaves:
/// no law is right to more than some percent. Waves of other lengths are other causes.
bool is_remainder(const Cell& cell, const Stage& stage, const Calibration& calibration,
                  const Found& found) {
  double largest = 0.0;
  for (const auto& part : parts_of(cell, calibration))
    if ((part.entry.name != "gear_ripple" || found.entry.name != "gear_ripple") &&
        !refines(part.entry, found.entry))
      largest = std::max(largest, motion_of(part, stage, calibration));
  return std::sqrt(std::max(0.0, found.trial.explained) * stage.Q) < kRemainder * largest;
}

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

/// One selection under way.
class Selection {
 public:
  Selection(const ForwardStart& start, const Calibration& calibration, Stage stage, Scan look)
      : start_(start),
        now_{start.cell, calibration},
        stage_(std::move(stage)),
        look_(std::move(look)) {
    stage_.cell = &now_.cell;
  }

  Forward run() {
    Forward out;
    for (int step = 0; step < kMostSteps; ++step) {
      if (look_.unknown()) {
        out.unknown = unknown_structure(stage_, *look_.pattern);
        break;
      }
      const Found* best = look_.supported(
          [&](const Found& f) { return !is_remainder(now_.cell, stage_, now_.calibration, f); });
      if (best == nullptr && !exchange()) break;
      if (best != nullptr) add(Found(*best));
    }
    out.steps = steps();
    return out;
  }

 private:
  struct Model {
    Cell cell;
    Calibration calibration;
  };

  Model fitted(const std::vector<EffectEntry>& effects) const {
    Model out{start_.cell,
              refitted(start_.cell, start_.measured, start_.fit, effects, now_.calibration)};
    out.cell.effects = effects;
    return out;
  }

  Stage stage_of(const Model& model) const {
    return make_stage(model.cell, start_.measured, model.calibration,
                      without_outliers(start_.fit, model.calibration), {});
  }

  void look_at(Model model) {
    seen_.push_back(model);
    now_ = std::move(model);
    stage_ = stage_of(now_);
    look_ = scan(stage_, start_.not_testable, banned_);
  }

  void add(const Found& best) {
    if (start_.tell) start_.tell(key_of(now_.cell, best.entry));
    try {
      Model next = fitted(with_all(now_.cell.effects, best));
      const Stage stage = stage_of(next);
      added_.push_back(best);
      if (const auto weak =
              lost(next.cell, stage, next.calibration, start_.cell.effects, best.entry)) {
        // One wave of many may come and go; what does so again stays away.
        const std::string key = key_of(next.cell, *weak);
        if (weak->name != "gear_ripple" || ++dropped_[key] > 2) banned_.push_back(key);
        forget(*weak);
        next = fitted(without_effect(next.cell.effects, *weak));
      }
      look_at(std::move(next));
    } catch (const Failure&) {
      // An effect that cannot be fitted jointly is none that these poses support.
      banned_.push_back(key_of(now_.cell, best.entry));
      look_ = scan(stage_, start_.not_testable, banned_);
    }
  }

  /// What was chosen first was chosen while the others were still missing. Each effect is taken
  /// out once and looked for again; true if another one does its work better.
  bool exchange() {
    if (added_.size() < 2) return false;
    for (const auto& found : added_) {
      const EffectEntry entry = found.entry;
      const std::string key = key_of(now_.cell, entry);
      if (entry.name == "gear_ripple" || tried_.contains(key) || tried_.size() >= kMostExchanges)
        continue;
      tried_.insert(key);
      try {
        const Model without = fitted(without_effect(now_.cell.effects, entry));
        const Stage stage = stage_of(without);
        const Scan look = scan(stage, start_.not_testable, banned_);
        const Found* other = look.supported();
        if (other == nullptr || key_of(now_.cell, other->entry) == key) continue;
        const auto own =
            std::find_if(look.library.begin(), look.library.end(),
                         [&](const Found& f) { return key_of(now_.cell, f.entry) == key; });
        if (own != look.library.end() && other->ln_bayes() < own->ln_bayes() + kSupported) continue;
        const Found chosen = *other;
        look_at(fitted(with_all(without.cell.effects, chosen)));
        forget(entry);
        added_.push_back(chosen);
        return true;
      } catch (const Failure&) {
        continue;
      }
    }
    return false;
  }

  /// A wave of a ripple may go alone; its fellows stay.
  void forget(const EffectEntry& entry) {
    for (auto& found : added_) {
      if (found.entry.name != entry.name || found.entry.joints != entry.joints) continue;
      if (entry.name == "gear_ripple")
        std::erase(found.cycles, std::get<double>(entry.options.at("cycles_per_turn")));
      else if (found.entry.options == entry.options)
        found.entry.name.clear();
      if (found.entry.name == "gear_ripple" && found.cycles.empty()) found.entry.name.clear();
    }
    std::erase_if(added_, [](const auto& a) { return a.entry.name.empty(); });
  }

  /// The effects one by one, each with the model as it was then.
  std::vector<ForwardStep> steps() {
    std::vector<ForwardStep> out;
    auto effects = start_.cell.effects;
    for (const auto& found : added_) {
      effects = with_all(effects, found);
      const bool last = out.size() + 1 == added_.size();
      EffectEntry entry = found.entry;
      if (!found.cycles.empty()) entry.options["cycles_per_turn"] = found.cycles.front();
      out.push_back(
          {entry, found.cycles, found.ln_bayes(), last ? now_.cell.effects : effects, {}});
    }
    // The models on the way are only looked at once all is chosen.
    for (auto& step : out) step.calibration = calibration_of(step.effects);
    return out;
  }

  /// A model on the way: most were fitted when they were the present one.
  Calibration calibration_of(const std::vector<EffectEntry>& effects) const {
    if (same(effects, now_.cell.effects)) return now_.calibration;
    for (const auto& model : seen_)
      if (same(effects, model.cell.effects)) return model.calibration;
    return fitted(effects).calibration;
  }

  static bool same(const std::vector<EffectEntry>& a, const std::vector<EffectEntry>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const EffectEntry& x, const EffectEntry& y) {
                        return x.name == y.name && x.joints == y.joints && x.options == y.options;
                      });
  }

  static std::vector<EffectEntry> with_all(std::vector<EffectEntry> effects, const Found& found) {
    for (const auto& entry : found.entries()) effects = with_effect(std::move(effects), entry);
    return effects;
  }

  const ForwardStart& start_;
  Model now_;
  std::vector<Model> seen_;
  Stage stage_;
  Scan look_;
  std::vector<std::string> banned_;
  std::vector<Found> added_;
  std::map<std::string, int> dropped_;
  std::set<std::string> tried_;
};

/// Numbers that the new list of effects shares with the old one stay: a better start.
void keep_values(const ArmState& old, ArmState& fresh) {
  std::map<std::string, double> values;
  for (const auto& p : effect_parameters(old.arm)) values[p.name] = value_of(old, p);
  for (const auto& p : effect_parameters(fresh.arm))
    if (const auto it = values.find(p.name); it != values.end())
      fresh.arm.effects[p.joint].parameters[p.component] = it->second;
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
  keep_values(from.state, start);
  return calibrate_from(with, measured, fit, start);
}

Forward forward(const ForwardStart& start, const Calibration& calibration, Stage stage,
                const Scan& first) {
  return Selection(start, calibration, std::move(stage), first).run();
}

}  // namespace plumb::offline
