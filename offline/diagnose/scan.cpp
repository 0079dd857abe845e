// SPDX-License-Identifier: Apache-2.0
#include "diagnose/scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "arm/effect_binding.hpp"
#include "diagnose/change_points.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/few_digits.hpp"
#include "diagnose/held_out.hpp"
#include "diagnose/joint_groups.hpp"
#include "diagnose/ripple_scan.hpp"
#include "diagnose/series_scan.hpp"
#include "effects/registry.hpp"
#include "solve/series_numbers.hpp"

namespace plumb::offline {
namespace {

template <class T>
bool contains(const std::vector<T>& all, const T& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// Whether the model has that law at that joint with another constant. A joint has one spring, one
/// backlash and one friction; a second one would only bend the first.
bool has_with_other_constant(const WhitenedFit& whitened, const EffectEntry& entry) {
  if (!descriptor_of(entry.name).once_a_joint) return false;
  EffectEntry any = entry;
  any.options.clear();
  return std::any_of(whitened.cell->effects.begin(), whitened.cell->effects.end(),
                     [&](EffectEntry old) {
                       old.options.clear();
                       return has_effect({old}, any);
                     });
}

/// Whether a series that the model has describes the same motion.
bool is_in_a_series(const WhitenedFit& whitened, const EffectEntry& entry) {
  return descriptor_of(entry.name).cause == Cause::kUnevenGear && entry.joints.size() == 1 &&
         has_series_at(whitened.cell->effects, entry.joints.front());
}

/// Whether an entry is not to be tried: it failed before, or the model has it.
bool is_out(const WhitenedFit& whitened, const std::vector<std::string>& banned,
            const std::string& key, const EffectEntry& entry) {
  return contains(banned, key) || has_effect(whitened.cell->effects, entry) ||
         has_with_other_constant(whitened, entry) ||
         (!is_wave(entry.name) && is_in_a_series(whitened, entry));
}

/// Waves of one joint as one candidate. The evidence is lowered by the price of the search for each
/// wave.
std::optional<Found> found_ripples(const Scorer& scorer, Ripples waves, double paid) {
  const bool in_series = has_series_at(scorer.whitened().cell->effects, waves.joint);
  if (in_series)
    std::erase_if(waves.cycles, [](double k) { return std::abs(k - std::round(k)) < kWholeWave; });
  if (waves.cycles.empty()) return std::nullopt;
  const Regressor regressor = ripple_regressor(scorer.whitened(), waves.joint, waves.cycles);
  Found out{regressor.entry, {}, scorer.score(regressor), {}, 0.0, waves.cycles, 0.0};
  const auto count = static_cast<double>(waves.cycles.size());
  const double strongest = waves.strongest_ln_bayes - scorer.whitened().scatter_nats;
  out.score =
      waves.cycles.size() == 1 && !in_series ? strongest - paid : out.ln_bayes() - count * paid;
  // Beside a series only a wave that it clearly cannot make.
  if (in_series) out.score -= kAhead_nats;
  return out;
}

/// By how much the held-out error falls with a candidate. Waves are chosen anew without each fold.
Gain gain_of(const Scorer& scorer, const Found& found, double regressors) {
  if (!is_wave(found.entry.name)) return scorer.gain(found.scored);
  const int joint = found.entry.joints.front();
  return scorer.gain(scored_without_folds(
      scorer, joint, waves_without_folds(scorer, joint, found.cycles, regressors)));
}

/// A part that moved once or several times, scored with the price of finding every further move.
Found found_moves(const Scorer& scorer, const ChangePoint& point) {
  const Regressor regressor = moves_regressor(scorer.whitened(), point.entry, point.after_rows);
  Found out{point.entry, {}, score_moves(scorer, regressor, point.after_rows.size()), {}, 0.0,
            {},          0.0};
  out.moves = sized_moves(scorer.whitened(), regressor, out.scored.theta);
  return out;
}

/// Collects the best of every effect and joint.
class Collector {
 public:
  Collector(const WhitenedFit& whitened, const Scorer& scorer,
            const std::vector<std::string>& banned)
      : whitened_(whitened), scorer_(scorer), banned_(banned) {}

  void take(const Regressor& regressor) {
    ++regressors_;
    const std::string key = key_of(*whitened_.cell, regressor.entry);
    if (is_out(whitened_, banned_, key, regressor.entry)) return;
    RegressorScore scored = scorer_.score(regressor);
    keep(best_[key], regressor, std::move(scored));
  }
  void take_pattern(const Regressor& regressor) {
    ++regressors_;
    const RegressorScore scored = scorer_.score(regressor);
    keep_pattern(pattern_, regressor, scored);
    if (regressor.pattern.slow) keep_pattern(slow_, regressor, scored);
  }
  void take(Found found) {
    ++regressors_;
    const std::string key = key_of(*whitened_.cell, found.entry);
    if (is_out(whitened_, banned_, key, found.entry)) return;
    std::optional<Found>& best = best_[key];
    if (!best || found.ln_bayes() > best->ln_bayes()) best = std::move(found);
  }
  void count(int more) { regressors_ += more; }

  std::map<std::string, std::optional<Found>> best_;
  std::optional<Found> pattern_, slow_;
  double regressors_ = 0.0;

 private:
  static bool keep(std::optional<Found>& best, const Regressor& regressor, RegressorScore scored) {
    if (best && best->ln_bayes() >= scored.evidence.ln_bayes) return false;
    best = Found{regressor.entry, regressor.pattern, std::move(scored), {}, 0.0, {}, 0.0};
    return true;
  }
  static void keep_pattern(std::optional<Found>& best, const Regressor& regressor,
                           const RegressorScore& scored) {
    if (!keep(best, regressor, scored) || regressor.joint < 0) return;
    const Eigen::VectorXd fitted = regressor.columns * best->scored.theta;
    best->rms_joint = std::sqrt(fitted.squaredNorm() / static_cast<double>(fitted.size()));
  }
  const WhitenedFit& whitened_;
  const Scorer& scorer_;
  const std::vector<std::string>& banned_;
};

/// For every joint at which a law of an uneven gear is supported: the law of that joint alone with
/// the highest score, whatever its cause.
std::map<int, const Found*> best_at_joints(const std::vector<Found>& library) {
  std::map<int, const Found*> best;
  std::set<int> uneven;
  for (const auto& found : library) {
    if (found.entry.joints.size() != 1 || !(found.score > kSupported)) continue;
    const int joint = found.entry.joints.front();
    if (descriptor_of(found.entry.name).cause == Cause::kUnevenGear) uneven.insert(joint);
    const Found*& at_joint = best[joint];
    if (at_joint == nullptr || found.score > at_joint->score) at_joint = &found;
  }
  std::erase_if(best, [&](const auto& at) { return !uneven.contains(at.first); });
  return best;
}

/// One series at these joints.
std::optional<Found> series_at(const Scorer& scorer, const std::vector<int>& joints, double paid) {
  auto series = scan_series(scorer, joints);
  if (!series) return std::nullopt;
  Found out{series->entry, {}, std::move(series->scored), {}, 0.0, {}, 0.0};
  out.score = out.ln_bayes() - paid;
  return out;
}

/// Whether a series of waves replaces the best law of its joint. Several single waves are replaced
/// as soon as the series has more evidence; a law with fewer parameters is kept unless the series
/// also explains clearly more.
bool takes_the_place(const Found& series, const Found& best) {
  if (best.cycles.size() >= kFewestForSeries) return series.score > best.score;
  return series.score > best.score + kAhead_nats &&
         series.scored.explained > best.scored.explained + kAhead_share;
}

/// One series of waves at every joint where it has more evidence than any law of that joint.
std::optional<Found> found_series(const Scorer& scorer, const std::vector<Found>& library,
                                  double paid) {
  const WhitenedFit& s = scorer.whitened();
  std::vector<int> joints;
  std::optional<Found> out;
  for (const auto& [joint, best] : best_at_joints(library)) {
    if (!s.chain.revolute(joint) || has_series_at(s.cell->effects, joint)) continue;
    auto alone = series_at(scorer, {joint}, paid);
    if (!alone || !takes_the_place(*alone, *best)) continue;
    joints.push_back(joint);
    out = std::move(alone);
  }
  if (joints.size() > 1) out = series_at(scorer, joints, paid);
  if (out) out->peaks = peaks_of(s, out->entry, out->scored);
  return out;
}

/// Largest value of the refined option; beyond it the law degenerates into another one.
double most_of(const WhitenedFit& whitened, const EffectEntry& entry,
               const Refinement& refinement) {
  return refinement.kind == Refinement::Most::kOfLargestTorque
             ? refinement.most * largest_torque(whitened, entry.joints.front())
             : refinement.most;
}

/// A pitch changes by a quarter of a period over the travel: half a step of its grid.
double first_factor(const WhitenedFit& whitened, const EffectEntry& entry,
                    const Refinement& refinement) {
  if (!refinement.of_travel) return refinement.factor;
  const double pitch = 1e-3 * number_option(entry, refinement.key, 0.0);
  return 1.0 + 0.25 * pitch / std::max(travel_of(whitened, entry.joints.front()), kLeastTravel_m);
}

/// Climbs from the best value on the grid, by a factor that shrinks where no neighbour is better.
void refine(const WhitenedFit& whitened, const Scorer& scorer, Found& found) {
  const Refinement* refinement = refinement_of(*whitened.cell, found.entry);
  if (refinement == nullptr) return;
  const double most = most_of(whitened, found.entry, *refinement);
  double factor = first_factor(whitened, found.entry, *refinement);
  const double finest =
      refinement->of_travel ? 1.0 + kFinestOfTravel * (factor - 1.0) : kFinestFactor;
  for (int i = 0; i < kRefinements; ++i) {
    bool better = false;
    for (const double sign : {-1.0, 1.0}) {
      EffectEntry entry = found.entry;
      const double value = number_option(entry, refinement->key, 0.0) * std::pow(factor, sign);
      if (!(value > 0.0 && value <= most)) continue;
      set_option(entry, refinement->key, value);
      RegressorScore scored = scorer.score(library_regressor(whitened, entry));
      if (scored.evidence.ln_bayes <= found.ln_bayes()) continue;
      found.entry = std::move(entry);
      found.scored = std::move(scored);
      better = true;
      break;
    }
    if (better) continue;
    factor = std::sqrt(factor);
    if (factor < finest) break;
  }
}

/// Rounds the refined option to few digits, because it is written into the cell file.
void round_refined(const WhitenedFit& whitened, const Scorer& scorer, Found& found) {
  const Refinement* refinement = refinement_of(*whitened.cell, found.entry);
  if (refinement == nullptr) return;
  const double value = number_option(found.entry, refinement->key, 0.0);
  set_option(found.entry, refinement->key,
             refinement->of_travel ? five_digits(value) : three_digits(value));
  found.scored = scorer.score(library_regressor(whitened, found.entry));
}

/// The joints at which fast waves are tried. None if the best candidate leaves hardly more than
/// noise, or is another law that explains most of what is left; the joint of the best candidate if
/// that is slow waves, as fast ones may look like them; all joints that turn if nothing was found,
/// or only a pattern or a weak effect.
std::vector<int> joints_for_fast_waves(const WhitenedFit& whitened, const Scan& look) {
  const Found* best = look.unknown() ? &*look.pattern : look.supported();
  const double left = best == nullptr ? 1.0 : 1.0 - best->scored.explained;
  if (left * times_noise(whitened) < kAboveNoise) return {};
  if (best != nullptr && is_wave(best->entry.name)) return best->entry.joints;
  if (best != nullptr && best->pattern.empty() && best->scored.explained > kMostOfIt) return {};
  std::vector<int> out;
  for (int j = 0; j < whitened.joints(); ++j)
    if (whitened.chain.revolute(j)) out.push_back(j);
  return out;
}

/// Fast waves; they replace the slow ones of the same joint where they explain more. Only they pay
/// the price of their search, because it is made only when nothing else explains the residual.
void add_fast_waves(const Scorer& scorer, const std::vector<std::string>& banned, Scan& out) {
  const WhitenedFit& whitened = scorer.whitened();
  int tried = 0;
  std::vector<Ripples> fast;
  for (const int joint : joints_for_fast_waves(whitened, out))
    fast.push_back(scan_fast_ripples(scorer, joint, tried));
  if (fast.empty()) return;
  const double paid = std::log(std::max(1.0, out.regressors + tried));
  for (const auto& waves : fast) {
    auto found = found_ripples(scorer, waves, paid);
    if (!found || is_out(whitened, banned, key_of(*whitened.cell, found->entry), found->entry))
      continue;
    if (!(found->score > kSupported)) continue;
    found->gain = gain_of(scorer, *found, out.regressors);
    const auto slow = std::find_if(out.library.begin(), out.library.end(), [&](const Found& f) {
      return is_wave(f.entry.name) && f.entry.joints == found->entry.joints;
    });
    if (slow == out.library.end())
      out.library.push_back(std::move(*found));
    else if (found->score > slow->score)
      *slow = std::move(*found);
  }
  out.regressors += tried;
}

void sort_by_evidence(Scan& out) {
  std::stable_sort(out.library.begin(), out.library.end(),
                   [](const Found& a, const Found& b) { return a.ln_bayes() > b.ln_bayes(); });
}

/// Where orientations are measured, points or orientations must show an effect by themselves.
void drop_what_neither_shows(const Scorer& scorer, Scan& out) {
  for (auto& found : out.library)
    if (found.score > kSupported && found.gain.clear &&
        !shown_by_points_or_turns(scorer, regressor_of(scorer.whitened(), found), found.scored))
      found.gain.clear = false;
}

}  // namespace

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
  // Several steps in time can imitate nearly anything that varies slowly.
  const double more = is_change_point(best.entry.name) ? 0.0 : kAhead_share;
  return pattern->ln_bayes() > best.ln_bayes() + kAhead_nats &&
         pattern->scored.explained > best.scored.explained + more;
}

Scan scan(const WhitenedFit& whitened, const std::vector<std::string>& not_testable,
          const std::vector<std::string>& banned) {
  const Scorer scorer(whitened);
  Collector all(whitened, scorer, banned);
  visit_library(whitened, not_testable, [&](const Regressor& b) { all.take(b); });
  if (!contains(not_testable, change_point_effect())) {
    int cuts = 0;
    for (const auto& point : change_points(whitened, cuts)) {
      Found found = found_moves(scorer, point);
      if (found.scored.theta.size() > 0) all.take(std::move(found));
    }
    all.count(cuts);
  }
  visit_patterns(whitened, [&](const Regressor& b) { all.take_pattern(b); });
  std::vector<Ripples> ripples;
  for (int j = 0; j < whitened.joints(); ++j) {
    if (!whitened.chain.revolute(j) || contains(not_testable, wave_effect())) continue;
    int waves = 0;
    ripples.push_back(scan_ripples(scorer, j, all.regressors_, waves));
    all.count(waves);
  }
  Scan out;
  out.regressors = all.regressors_;
  const double paid = std::log(std::max(1.0, all.regressors_));
  for (auto& [key, found] : all.best_) {
    // What is gained off the grid was searched for as well: it does not count.
    found->score = found->ln_bayes() - paid;
    if (found->score > 0.0) {
      refine(whitened, scorer, *found);
      round_refined(whitened, scorer, *found);
    }
    // Refinement may end where the model already stands.
    if (is_out(whitened, banned, key, found->entry)) continue;
    out.library.push_back(std::move(*found));
  }
  for (const auto& waves : ripples)
    if (auto found = found_ripples(scorer, waves, paid);
        found && !contains(banned, key_of(*whitened.cell, found->entry)))
      out.library.push_back(std::move(*found));
  sort_by_evidence(out);
  for (auto& group : joint_groups(scorer, out.library))
    if (!is_out(whitened, banned, key_of(*whitened.cell, group.entry), group.entry))
      out.library.push_back(std::move(group));
  out.pattern = std::move(all.pattern_);
  out.slow = std::move(all.slow_);
  for (std::optional<Found>* pattern : {&out.pattern, &out.slow})
    if (*pattern) (*pattern)->score = (*pattern)->ln_bayes() - paid;
  sort_by_evidence(out);
  for (auto& found : out.library)
    if (found.score > kSupported) found.gain = gain_of(scorer, found, out.regressors);
  for (std::optional<Found>* pattern : {&out.pattern, &out.slow})
    if (*pattern && (*pattern)->score > kSupported)
      (*pattern)->gain = scorer.gain((*pattern)->scored);
  if (!contains(not_testable, wave_effect())) {
    add_fast_waves(scorer, banned, out);
    sort_by_evidence(out);
  }
  // Last, beside everything that may say it in fewer numbers.
  if (!contains(not_testable, series_effect()))
    if (auto series = found_series(scorer, out.library, paid);
        series && !contains(banned, key_of(*whitened.cell, series->entry))) {
      if (series->score > kSupported) series->gain = scorer.gain(series->scored);
      // Each of several waves was searched for, which their evidence does not show.
      std::erase_if(out.library, [&](const Found& f) {
        return f.cycles.size() >= kFewestForSeries &&
               contains(series->entry.joints, f.entry.joints.front());
      });
      out.library.push_back(std::move(*series));
      sort_by_evidence(out);
    }
  if (whitened.turns()) drop_what_neither_shows(scorer, out);
  return out;
}

}  // namespace plumb::offline
