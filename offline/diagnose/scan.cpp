// SPDX-License-Identifier: Apache-2.0
#include "diagnose/scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnose/change_points.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/few_digits.hpp"
#include "diagnose/joint_groups.hpp"
#include "diagnose/ripple_scan.hpp"

namespace plumb::offline {
namespace {

constexpr double kAhead_share = 0.05;  // of what is left: a pattern over the library's best
constexpr int kRefinements = 12;
constexpr double kLongestTransition_deg = 3.0;  // beyond it is no friction
constexpr double kWidestTransition = 0.35;      // of the largest torque: beyond it is a spring

const std::vector<std::string> kOnceAJoint = {"joint_compliance_soft", "backlash_load", "reversal",
                                              "gravity_compensator"};

bool contains(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// Whether the model has that law at that joint with another constant. A joint has one spring, one
/// backlash and one friction; a second one would only bend the first.
bool has_with_other_constant(const Stage& stage, const EffectEntry& entry) {
  if (!contains(kOnceAJoint, entry.name)) return false;
  EffectEntry any = entry;
  any.options.clear();
  return std::any_of(stage.cell->effects.begin(), stage.cell->effects.end(), [&](EffectEntry old) {
    old.options.clear();
    return has_effect({old}, any);
  });
}

/// Whether an entry is not to be tried: it failed before, or the model has it.
bool is_out(const Stage& stage, const std::vector<std::string>& banned, const std::string& key,
            const EffectEntry& entry) {
  return contains(banned, key) || has_effect(stage.cell->effects, entry) ||
         has_with_other_constant(stage, entry);
}

/// Waves of one joint as one candidate. Each of them was searched for, so each pays.
std::optional<Found> found_ripples(const Judge& judge, const Ripples& waves, double paid) {
  if (waves.cycles.empty()) return std::nullopt;
  const Block block = ripple_block(judge.stage(), waves.joint, waves.cycles);
  Found out{block.entry, {}, judge.judge(block), {}, 0.0, waves.cycles, 0.0};
  const auto count = static_cast<double>(waves.cycles.size());
  out.score =
      waves.cycles.size() == 1 ? waves.strongest_ln_bayes - paid : out.ln_bayes() - count * paid;
  return out;
}

/// Collects the best of every effect and joint.
class Collector {
 public:
  Collector(const Stage& stage, const Judge& judge, const std::vector<std::string>& banned)
      : stage_(stage), judge_(judge), banned_(banned) {}

  void take(const Block& block) {
    ++blocks_;
    const std::string key = key_of(*stage_.cell, block.entry);
    if (is_out(stage_, banned_, key, block.entry)) return;
    Trial trial = judge_.judge(block);
    keep(best_[key], block, std::move(trial));
  }
  void take_pattern(const Block& block) {
    ++blocks_;
    if (!keep(pattern_, block, judge_.judge(block)) || block.joint < 0) return;
    const Eigen::VectorXd fitted = block.columns * pattern_->trial.theta;
    pattern_->rms_joint = std::sqrt(fitted.squaredNorm() / static_cast<double>(fitted.size()));
  }
  void count(int more) { blocks_ += more; }

  std::map<std::string, std::optional<Found>> best_;
  std::optional<Found> pattern_;
  double blocks_ = 0.0;

 private:
  static bool keep(std::optional<Found>& best, const Block& block, Trial trial) {
    if (best && best->ln_bayes() >= trial.evidence.ln_bayes) return false;
    best = Found{block.entry, block.pattern, std::move(trial), {}, 0.0, {}, 0.0};
    return true;
  }
  const Stage& stage_;
  const Judge& judge_;
  const std::vector<std::string>& banned_;
};

/// Non-linear number of an entry and how far its neighbours on the grid are.
struct Knob {
  const char* key;
  double step;  // added, or as a factor
  bool factor;
  double most;
};
std::optional<Knob> knob_of(const Stage& stage, const EffectEntry& entry) {
  if (entry.name == "backlash_load" || entry.name == "joint_compliance_soft")
    return Knob{"torque_Nm", 1.7, true,
                kWidestTransition * largest_torque(stage, entry.joints.front())};
  if (entry.name == "reversal") return Knob{"transition_deg", 1.7, true, kLongestTransition_deg};
  return std::nullopt;
}

/// Climbs from the grid's best number, halving the step.
void refine(const Stage& stage, const Judge& judge, Found& found) {
  auto knob = knob_of(stage, found.entry);
  if (!knob) return;
  for (int i = 0; i < kRefinements; ++i) {
    bool better = false;
    for (const double sign : {-1.0, 1.0}) {
      EffectEntry entry = found.entry;
      double& value = std::get<double>(entry.options[knob->key]);
      value = knob->factor ? value * std::pow(knob->step, sign) : value + sign * knob->step;
      if (!(value > 0.0 && value <= knob->most)) continue;
      Trial trial = judge.judge(library_block(stage, entry));
      if (trial.evidence.ln_bayes <= found.ln_bayes()) continue;
      found.entry = std::move(entry);
      found.trial = std::move(trial);
      better = true;
      break;
    }
    if (better) continue;
    knob->step = knob->factor ? std::sqrt(knob->step) : 0.5 * knob->step;
    if (knob->factor ? knob->step < 1.05 : knob->step < 0.004) break;
  }
}

/// Refinement comes to numbers with many digits; nobody wants them in a cell file.
void round_knob(const Stage& stage, const Judge& judge, Found& found) {
  const auto knob = knob_of(stage, found.entry);
  if (!knob) return;
  double& value = std::get<double>(found.entry.options[knob->key]);
  value = knob->factor ? three_digits(value) : std::round(100.0 * value) / 100.0;
  found.trial = judge.judge(library_block(stage, found.entry));
}

/// The joints where waves faster than the usual ones are worth a look, while what is left is
/// clearly wrong and would stay so: all of them if nothing was found, or no law; that of slow waves
/// if they are the best, since fast ones may look like them.
std::vector<int> joints_for_fast_waves(const Stage& stage, const Scan& look) {
  const Found* best = look.unknown() ? &*look.pattern : look.supported();
  const double left = best == nullptr ? 1.0 : 1.0 - best->trial.explained;
  if (left * times_noise(stage) < kAboveNoise) return {};
  if (best != nullptr && best->entry.name == "gear_ripple") return best->entry.joints;
  if (best != nullptr && best->pattern.empty()) return {};
  std::vector<int> out;
  for (int j = 0; j < stage.joints(); ++j)
    if (stage.chain.revolute(j)) out.push_back(j);
  return out;
}

/// Fast waves, in place of the slow ones of the same joint where they explain more. They alone pay
/// for their search: it is made only when all else has failed.
void add_fast_waves(const Stage& stage, const Judge& judge, const std::vector<std::string>& banned,
                    Scan& out) {
  int tried = 0;
  std::vector<Ripples> fast;
  for (const int joint : joints_for_fast_waves(stage, out))
    fast.push_back(scan_fast_ripples(judge, joint, tried));
  if (fast.empty()) return;
  const double paid = std::log(std::max(1.0, out.blocks + tried));
  for (const auto& waves : fast) {
    auto found = found_ripples(judge, waves, paid);
    if (!found || is_out(stage, banned, key_of(*stage.cell, found->entry), found->entry)) continue;
    if (!(found->score > kSupported)) continue;
    found->gain = judge.gain(found->trial);
    const auto slow = std::find_if(out.library.begin(), out.library.end(), [&](const Found& f) {
      return f.entry.name == "gear_ripple" && f.entry.joints == found->entry.joints;
    });
    if (slow == out.library.end())
      out.library.push_back(std::move(*found));
    else if (found->score > slow->score)
      *slow = std::move(*found);
  }
  out.blocks += tried;
}

}  // namespace

std::vector<EffectEntry> Found::entries() const {
  if (entry.name != "gear_ripple") return {entry};
  std::vector<EffectEntry> out;
  for (const double k : cycles) {
    out.push_back(entry);
    out.back().options["cycles_per_turn"] = k;
  }
  return out;
}

Block block_of(const Stage& stage, const Found& found) {
  return found.entry.name == "gear_ripple"
             ? ripple_block(stage, found.entry.joints.front(), found.cycles)
             : library_block(stage, found.entry);
}

std::string key_of(const Cell& cell, const EffectEntry& entry) {
  std::string out = entry.name;
  for (std::size_t i = 0; i < entry.joints.size(); ++i)
    out += (i == 0 ? ":" : ",") + cell.nominal.joints[entry.joints[i]].name;
  if (entry.name == "step") out += "/" + std::get<std::string>(entry.options.at("of"));
  return out;
}

const Found* Scan::supported(const std::function<bool(const Found&)>& also) const {
  for (const auto& found : library)
    if (found.score > kSupported && found.gain.clear && (!also || also(found))) return &found;
  return nullptr;
}

const Found* Scan::find(const Cell& cell, const std::string& key) const {
  const auto it = std::find_if(library.begin(), library.end(),
                               [&](const Found& f) { return key_of(cell, f.entry) == key; });
  return it == library.end() ? nullptr : &*it;
}

bool Scan::unknown() const {
  if (!pattern || !(pattern->score > kSupported) || !pattern->gain.clear) return false;
  if (library.empty()) return true;
  const Found& best = library.front();
  return pattern->ln_bayes() > best.ln_bayes() + kAhead_nats &&
         pattern->trial.explained > best.trial.explained + kAhead_share;
}

Scan scan(const Stage& stage, const std::vector<std::string>& not_testable,
          const std::vector<std::string>& banned) {
  const Judge judge(stage);
  Collector all(stage, judge, banned);
  visit_library(stage, not_testable, [&](const Block& b) { all.take(b); });
  if (!contains(not_testable, "step")) {
    int cuts = 0;
    for (const auto& point : change_points(stage, cuts)) {
      const Block block = library_block(stage, point.entry);
      if (block.columns.cols() > 0) all.take(block);
    }
    all.count(cuts);
  }
  visit_patterns(stage, [&](const Block& b) { all.take_pattern(b); });
  std::vector<Ripples> ripples;
  for (int j = 0; j < stage.joints(); ++j) {
    if (!stage.chain.revolute(j) || contains(not_testable, "gear_ripple")) continue;
    int waves = 0;
    ripples.push_back(scan_ripples(judge, j, all.blocks_, waves));
    all.count(waves);
  }
  Scan out;
  out.blocks = all.blocks_;
  const double paid = std::log(std::max(1.0, all.blocks_));
  for (auto& [key, found] : all.best_) {
    // What is gained off the grid was searched for as well: it does not count.
    found->score = found->ln_bayes() - paid;
    if (found->score > 0.0) {
      refine(stage, judge, *found);
      round_knob(stage, judge, *found);
    }
    // Refinement may end where the model already stands.
    if (is_out(stage, banned, key, found->entry)) continue;
    out.library.push_back(std::move(*found));
  }
  for (const auto& waves : ripples)
    if (auto found = found_ripples(judge, waves, paid);
        found && !contains(banned, key_of(*stage.cell, found->entry)))
      out.library.push_back(std::move(*found));
  const auto by_evidence = [](const Found& a, const Found& b) {
    return a.ln_bayes() > b.ln_bayes();
  };
  std::stable_sort(out.library.begin(), out.library.end(), by_evidence);
  for (auto& group : joint_groups(judge, out.library))
    if (!is_out(stage, banned, key_of(*stage.cell, group.entry), group.entry))
      out.library.push_back(std::move(group));
  std::stable_sort(out.library.begin(), out.library.end(), by_evidence);
  for (auto& found : out.library)
    if (found.score > kSupported) found.gain = judge.gain(found.trial);
  out.pattern = std::move(all.pattern_);
  if (out.pattern) {
    out.pattern->score = out.pattern->ln_bayes() - paid;
    out.pattern->gain = judge.gain(out.pattern->trial);
  }
  if (!contains(not_testable, "gear_ripple")) {
    add_fast_waves(stage, judge, banned, out);
    std::stable_sort(out.library.begin(), out.library.end(), by_evidence);
  }
  return out;
}

}  // namespace plumb::offline
