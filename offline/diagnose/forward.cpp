// SPDX-License-Identifier: Apache-2.0
#include "diagnose/forward.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "cell/effects_edit.hpp"
#include "diagnose/candidates.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/model_parts.hpp"
#include "diagnose/real_fall.hpp"
#include "diagnose/refit.hpp"
#include "diagnose/rivals.hpp"
#include "plumb/format/limits.hpp"

namespace plumb::offline {
namespace {

constexpr int kMostSteps = 60;
constexpr std::size_t kMostExchanges = 4;
constexpr double kRealShare = 0.005;  // of the RMS, in a refit: half of what a scan must promise
constexpr std::size_t kMostEffects = format::kMaxEffects - 4;  // some are left to the user

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
      if (look_.unknown() && !is_remainder(now_.cell, stage_, now_.calibration, *look_.pattern)) {
        out.unknown = unknown_structure(stage_, *look_.pattern);
        break;
      }
      const Found* best = look_.supported(
          [&](const Found& f) { return !is_remainder(now_.cell, stage_, now_.calibration, f); });
      out.full = best != nullptr && now_.cell.effects.size() >= kMostEffects;
      if (out.full) break;
      if (best != nullptr)
        add(as_many_as_fit(with_fresh_waves(*best)));
      else if (!exchange() && !explain_better())
        break;
    }
    if (!out.unknown) out.unknown = behind_oversized();
    out.unlikely = std::move(unlikely_);
    out.steps = steps();
    return out;
  }

 private:
  struct Model {
    Cell cell;
    Calibration calibration;
  };

  Model fitted(const std::vector<EffectEntry>& effects, Refit how = Refit::kNearby) const {
    Model out{start_.cell,
              refitted(start_.cell, start_.measured, start_.fit, effects, now_.calibration, how)};
    out.cell.effects = effects;
    return out;
  }

  Stage stage_of(const Model& model) const {
    return make_stage(model.cell, start_.measured, model.calibration,
                      without_outliers(start_.fit, model.calibration.outliers), {});
  }

  /// The present model less an effect, and what then is missing. The stage refers to the model.
  struct Without {
    Model model;
    Stage stage;
    Scan look;
    Without(const Selection& s, const EffectEntry& entry, const std::vector<std::string>& banned)
        : model(s.fitted(without_effect(s.now_.cell.effects, entry))),
          stage(s.stage_of(model)),
          look(scan(stage, s.start_.not_testable, banned)) {}
    Without(const Without&) = delete;
    Without& operator=(const Without&) = delete;
  };

  void go_to(Without& there) {
    seen_.push_back(there.model);
    now_ = std::move(there.model);
    stage_ = std::move(there.stage);
    stage_.cell = &now_.cell;
    look_ = std::move(there.look);
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
      if (real_fall(start_.cell, start_.measured, start_.fit, now_.calibration, next.calibration) <
          kRealShare) {
        banned_.push_back(key_of(now_.cell, best.entry));
        look_ = scan(stage_, start_.not_testable, banned_);
        return;
      }
      const auto weak =
          lost(next.cell, stage_of(next), next.calibration, start_.cell.effects, best.entry);
      if (weak) next = fitted(without_effect(next.cell.effects, *weak));
      added_.push_back(best);
      if (weak) {
        // One wave of many may come and go; what does so again stays away.
        const std::string key = key_of(next.cell, *weak);
        if (weak->name != "gear_ripple" || ++dropped_[key] > 2) banned_.push_back(key);
        forget(*weak);
      }
      look_at(std::move(next));
    } catch (const Failure&) {
      // An effect that cannot be fitted jointly is none that these poses support.
      banned_.push_back(key_of(now_.cell, best.entry));
      look_ = scan(stage_, start_.not_testable, banned_);
    }
  }

  /// The strongest waves come first.
  Found as_many_as_fit(Found found) const {
    const std::size_t room = kMostEffects - std::min(kMostEffects, now_.cell.effects.size());
    if (found.cycles.size() > room) found.cycles.resize(room);
    return found;
  }

  /// Waves of a joint that has some already: those were found while something else was missing. All
  /// of them are looked for again, together, where the model then stands.
  Found with_fresh_waves(Found best) {
    const auto& effects = now_.cell.effects;
    const auto waves = [&](const EffectEntry& e) {
      return e.name == "gear_ripple" && e.joints == best.entry.joints;
    };
    const std::string key = key_of(now_.cell, best.entry);
    if (!waves(best.entry) || std::none_of(effects.begin(), effects.end(), waves) ||
        std::any_of(start_.cell.effects.begin(), start_.cell.effects.end(), waves) ||
        !renewed_.insert(key).second)
      return best;
    const EffectEntry all{
        .name = "gear_ripple", .joints = best.entry.joints, .options = {}, .place = {}};
    try {
      Without waves_out(*this, all, banned_);
      const Found* again = waves_out.look.find(now_.cell, key);
      if (again == nullptr || again->score <= kSupported) return best;
      Found fresh = *again;
      std::erase_if(added_, [&](const Found& f) { return key_of(now_.cell, f.entry) == key; });
      go_to(waves_out);
      return fresh;
    } catch (const Failure&) {
      return best;
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
        const Without without(*this, entry, banned_);
        const Found* other = without.look.supported();
        if (other == nullptr || key_of(now_.cell, other->entry) == key) continue;
        const Found* own = without.look.find(now_.cell, key);
        if (own != nullptr && other->ln_bayes() < own->ln_bayes() + kSupported) continue;
        const Found chosen = *other;
        look_at(fitted(with_all(without.model.cell.effects, chosen)));
        forget(entry);
        added_.push_back(chosen);
        return true;
      } catch (const Failure&) {
        continue;
      }
    }
    return false;
  }

  /// What is clearly wrong, but too small to be an effect beside the strongest one, may be the
  /// trace of two others that the strongest one stands for; true if those leave only noise.
  bool explain_better() {
    if (look_.supported() == nullptr || times_noise(stage_) < kAboveNoise) return false;
    const auto strongest = std::max_element(
        added_.begin(), added_.end(),
        [](const Found& a, const Found& b) { return a.ln_bayes() < b.ln_bayes(); });
    if (strongest == added_.end() || strongest->entry.name == "gear_ripple") return false;
    const EffectEntry entry = strongest->entry;
    const std::string key = key_of(now_.cell, entry);
    if (!doubted_.insert(key).second) return false;
    try {
      const Without without(*this, entry, banned_);
      const auto better =
          better_explanation(without.stage, without.look, key, start_.not_testable, banned_);
      if (!better) return false;
      auto effects = without.model.cell.effects;
      for (const auto& found : better->effects) effects = with_all(effects, found);
      look_at(fitted(effects));
      forget(entry);
      added_.insert(added_.end(), better->effects.begin(), better->effects.end());
      drop_weak(better->effects.back().entry);
      return true;
    } catch (const Failure&) {
      return false;
    }
  }

  /// Takes out what lost its evidence to `fresh`.
  void drop_weak(const EffectEntry& fresh) {
    while (const auto weak =
               lost(now_.cell, stage_, now_.calibration, start_.cell.effects, fresh)) {
      forget(*weak);
      look_at(fitted(without_effect(now_.cell.effects, *weak)));
    }
  }

  /// An effect of a size that hardly any arm has may describe something else: it does if its law
  /// rules that size out, if a pattern of no law explains as much, or if it leaves more than noise.
  /// Otherwise it is what it says, only large: a wrong constant, a worn gear.
  std::optional<UnknownStructure> behind_oversized() {
    for (const auto& one : oversized(now_.cell, stage_, now_.calibration, start_.cell.effects)) {
      const Without without(*this, one.entry, {});
      const auto& pattern = without.look.pattern;
      const bool only_large =
          one.possible && times_noise(stage_) < kAboveNoise && pattern &&
          evidence_of(without.stage, one.entry) > pattern->ln_bayes() + kAhead_nats;
      if (!pattern || only_large) {
        unlikely_.push_back(one);
        continue;
      }
      UnknownStructure out = unknown_structure(without.stage, *pattern);
      out.instead = one;
      for (const int joint : one.entry.joints) {
        const std::string q = fmt::format("q{}", joint + 1);
        auto& inputs = out.pattern.depends_on;
        if (std::find(inputs.begin(), inputs.end(), q) == inputs.end()) inputs.push_back(q);
      }
      return out;
    }
    return std::nullopt;
  }

  static double evidence_of(const Stage& stage, const EffectEntry& entry) {
    const Judge judge(stage);
    if (entry.name != "gear_ripple")
      return judge.judge(library_block(stage, entry)).evidence.ln_bayes;
    const double cycles = std::get<double>(entry.options.at("cycles_per_turn"));
    return judge.judge(ripple_block(stage, entry.joints.front(), {cycles})).evidence.ln_bayes;
  }

  /// A wave of a ripple may go alone, and a joint of several; their fellows stay.
  void forget(const EffectEntry& entry) {
    for (auto& found : added_) {
      if (found.entry.name != entry.name) continue;
      if (entry.name == "gear_ripple") {
        if (found.entry.joints != entry.joints) continue;
        std::erase(found.cycles, std::get<double>(entry.options.at("cycles_per_turn")));
        if (found.cycles.empty()) found.entry.name.clear();
        continue;
      }
      const auto rest = without_effect({found.entry}, entry);
      if (rest.empty())
        found.entry.name.clear();
      else
        found.entry = rest.front();
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
    if (out.empty()) return out;
    now_ = fitted(now_.cell.effects, Refit::kFully);
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
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_effect);
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
  std::vector<Oversized> unlikely_;
  std::map<std::string, int> dropped_;
  std::set<std::string> tried_, doubted_, renewed_;
};

}  // namespace

Forward forward(const ForwardStart& start, const Calibration& calibration, Stage stage,
                const Scan& first) {
  return Selection(start, calibration, std::move(stage), first).run();
}

}  // namespace plumb::offline
