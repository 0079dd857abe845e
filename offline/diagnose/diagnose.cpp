// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cell/effects_edit.hpp"
#include "cell/replicates.hpp"
#include "check/data_sense.hpp"
#include "diagnose/alternatives.hpp"
#include "diagnose/candidates.hpp"
#include "diagnose/certainty.hpp"
#include "diagnose/confounding.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/diagnosis_text.hpp"
#include "diagnose/formula_proposal.hpp"
#include "diagnose/forward_selection.hpp"
#include "diagnose/held_out.hpp"
#include "diagnose/held_out_predictions.hpp"
#include "diagnose/judged_fit.hpp"
#include "diagnose/model_parts.hpp"
#include "diagnose/other_gravity.hpp"
#include "diagnose/refit.hpp"
#include "diagnose/refused_steps.hpp"
#include "diagnose/series_of_all.hpp"
#include "diagnose/sharpen_steps.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "fit/few_poses.hpp"
#include "fit/measured_orientations.hpp"
#include "fit/split.hpp"

namespace plumb::offline {
namespace {

/// With fewer poses than this, the whole selection is repeated without each fold (nested
/// cross-validation). With more poses a fold hardly changes what is selected, and selecting six
/// times takes 5 s at 150 poses, 22 s at 500.
constexpr std::size_t kNestedBelow = 60;
/// The same where waves were added: each has a frequency that was chosen among hundreds.
constexpr std::size_t kNestedWithWavesBelow = 300;

/// The cell without local trees: a tree is learnt after all physical effects are in the model.
Cell physics_of(Cell cell) {
  std::erase_if(cell.effects, [](const EffectEntry& e) { return is_local_tree(e.name); });
  return cell;
}

/// The data and settings that all steps of a diagnosis share.
struct Work {
  Cell cell;
  const MeasurementFiles& measured;
  Split split;
  std::vector<int> fit, held;  // rows; `held` is empty where folds are held out in turn
  std::vector<int> choosing;   // those of `fit` by which the effects are selected
  std::vector<Testable> testable;
  std::vector<std::string> not_testable;
  std::vector<Testable> excluded;  // the same with the reasons
  const DiagnosisRequest& request;
  BadRows bad = {};

  bool all_choose() const { return choosing.size() == fit.size(); }
  ForwardStart start(const std::vector<int>& rows, bool quiet) const {
    std::function<void(const std::string&)> tell;
    if (!quiet && request.tell)
      tell = [this](const std::string& key) { request.tell("step 4 of 4, adding " + key); };
    return {cell, measured, rows, not_testable, std::move(tell), excluded};
  }
};

/// Held-out predictions of the model with this list of effects; the list itself is not selected
/// anew in each fold.
HeldOutPredictions held_out_of(const Work& w, const std::vector<EffectEntry>& effects,
                               const Calibration& fitted) {
  HeldOutPredictions out(w.cell.measurement, w.measured, w.split);
  if (w.split.folds == 0) out.put(fitted, w.fit, w.held);
  for (int k = 0; k < w.split.folds; ++k)
    out.put(refitted(w.cell, w.measured, fit_rows(w.split, k), effects, fitted),
            fit_rows(w.split, k), held_rows(w.split, k));
  return out;
}

/// Whether the selection itself is repeated without each fold (see kNestedBelow).
bool chosen_in_folds(const Work& w, const std::vector<ForwardStep>& steps) {
  if (w.split.folds == 0 || steps.empty()) return false;
  const bool waves = std::any_of(steps.begin(), steps.end(),
                                 [](const ForwardStep& step) { return is_wave(step.entry.name); });
  const Measurements some = pick(w.measured, w.fit);
  const std::vector<int> group = pose_groups(some);
  return std::set<int>(group.begin(), group.end()).size() <
         (waves ? kNestedWithWavesBelow : kNestedBelow);
}

/// Held-out predictions where the effects are selected anew without each fold.
HeldOutPredictions nested_held_out(const Work& w) {
  HeldOutPredictions out(w.cell.measurement, w.measured, w.split);
  for (int k = 0; k < w.split.folds; ++k) {
    if (w.request.tell)
      w.request.tell(fmt::format("step 4 of 4, fold {} of {}", k + 1, w.split.folds));
    const auto inside = fit_rows(w.split, k);
    const Calibration base = calibrate(w.cell, w.measured, inside);
    const JudgedFit at = judged(
        make_whitened_fit(w.cell, w.measured, base, without_outliers(inside, base.outliers), {}),
        w.not_testable, {});
    const ForwardSelection found =
        forward_selection(w.start(inside, true), base, at.whitened, at.look);
    out.put(found.steps.empty() ? base : found.steps.back().calibration, inside,
            held_rows(w.split, k));
  }
  return out;
}

/// What the number of fitted parameters makes inevitable [noise floors].
double unavoidable(const Work& w, const Calibration& fitted) {
  return unavoidable_ratio(fitted_coordinates(w.measured, w.split),
                           fitted.decided + fitted.series_dof);
}

/// The held-out error compared with what noise and the number of fitted parameters make inevitable.
std::optional<HeldOutExcess> held_out_excess_of(const Work& w, const HeldOutPredictions& held,
                                                const Calibration& fitted,
                                                const NoiseFloor& floor) {
  return held_out_excess(held.stats(w.bad).mean, floor, unavoidable(w, fitted));
}

/// The orientations at the end, where the fit uses them.
void judge_turns(const Work& w, const HeldOutPredictions& held, const Calibration& fitted,
                 FoundTurns& out) {
  out.after = held.turn_stats();
  out.excess = held_out_excess(out.after.mean, out.floor, unavoidable(w, fitted));
}

/// Steps of a diagnosis; with `apply` the last one is as long as there are effects to add.
constexpr const char* kSteps[] = {"calibrating", "trying every effect", "held-out errors",
                                  "adding effects"};

void tell_step(const DiagnosisRequest& request, std::size_t step) {
  if (request.tell)
    request.tell(fmt::format("step {} of {}, {}", step + 1, request.apply ? 4 : 3, kSteps[step]));
}

/// Whether the arm has joints to which the effect applies: laws of a rail need a sliding joint.
bool arm_can_have(const Cell& cell, const std::string& effect) {
  const EffectDescriptor* law = find_descriptor(effect);
  return law == nullptr || law->joints != JointList::kSliding ||
         std::any_of(cell.nominal.joints.begin(), cell.nominal.joints.end(),
                     [](const auto& joint) { return joint.type == format::JointType::kPrismatic; });
}

bool judgeable(const WhitenedFit& whitened) {
  return static_cast<double>(whitened.fit_lines - whitened.rank) >= kFewestFreeLines;
}

/// The model as it is, and what is seen in its residuals.
struct Looked {
  Calibration base;
  WhitenedFit plain;
  JudgedFit at;
};

Looked looked(const Work& w, const Cell& cell) {
  Looked out{calibrate(cell, w.measured, w.choosing), {}, {}};
  tell_step(w.request, 1);
  out.plain = make_whitened_fit(cell, w.measured, out.base,
                                without_outliers(w.choosing, out.base.outliers), w.held);
  out.at = judged(out.plain, w.not_testable, {});
  return out;
}

/// Gravity in another direction than stated, decided by the points alone: errors of orientations
/// that repeats do not show may look like any load.
std::optional<UnderOtherGravity> gravity_by_points(const Work& w, const Looked& seen) {
  const auto decided = [&](const Cell& cell, const Looked& by) {
    return under_other_gravity(cell, w.measured, by.base, w.choosing, w.held, by.plain, by.at,
                               w.not_testable);
  };
  if (!seen.plain.turns()) return decided(w.cell, seen);
  Cell points = w.cell;
  points.measurement.sigma_rad.reset();
  return decided(points, looked(w, points));
}

/// Takes over the gravity that was found.
void look_under(UnderOtherGravity turned, Work& w, Looked& seen) {
  w.cell.gravity = turned.gravity.found;
  if (seen.plain.turns()) {
    seen = looked(w, w.cell);
    return;
  }
  seen.base = std::move(turned.calibration);
  seen.at = std::move(turned.judged);
  seen.at.whitened.cell = &w.cell;
  seen.plain = make_whitened_fit(w.cell, w.measured, seen.base,
                                 without_outliers(w.choosing, seen.base.outliers), w.held);
}

/// The facts that are known after the first scan.
Facts facts_of(const Scan& look, const WhitenedFit& whitened, const Calibration& calibration) {
  const auto is_one = [&](const Found& f) {
    return !is_remainder(*whitened.cell, whitened, calibration, f);
  };
  const bool can_tell = judgeable(whitened);
  return {.judgeable = can_tell,
          .structure = can_tell && look.unknown() && is_one(*look.pattern),
          .law = can_tell && look.supported(is_one) != nullptr,
          .noise_known = whitened.noise.known};
}

void say_what_was_not_judged(const ForwardSelection& found, Diagnosis& out) {
  if (found.not_judged.empty()) return;
  out.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-DIAGNOSE-UNJUDGED",
       .message = fmt::format("{} could not be refitted, so that nothing is known of {}: the model "
                              "{}",
                              found.not_judged.size() == 1 ? "one model" : "some models",
                              found.not_judged.size() == 1 ? "it" : "them",
                              fmt::join(found.not_judged, "; the model ")),
       .help = "plumb explain W-DIAGNOSE-UNJUDGED"});
}

/// Refits the final model, selected by some of the readings, to all of them.
void fit_to_all(const Work& w, std::vector<ForwardStep>& steps) {
  sharpen_steps(w.cell, w.measured, {w.choosing, w.fit}, steps);
  ForwardStep& last = steps.back();
  last.calibration = refitted(w.cell, w.measured, w.fit, last.effects, last.calibration);
}

/// If the first candidate is the first effect that was added, its errors are those of the refit, so
/// that the sentence and the table below it show the same numbers.
void take_over_first(Diagnosis& out) {
  if (out.added.empty() || out.candidates.empty()) return;
  Candidate& first = out.candidates.front();
  const Addition& added = out.added.front();
  if (same_effect(first.entry, added.entry) && first.cycles == added.cycles &&
      first.moves.size() == added.moves.size()) {
    first.alone = first.after = added.held;
    first.alone_turns = added.turns;
  }
}

/// The candidates are judged to first order, with single touches of each point held out. Where
/// whole placements are held out the error of the model as it is is larger, and theirs with it, to
/// first order by the same factor.
void as_by_placements(const WhitenedFit& plain, Diagnosis& out) {
  if (plain.measured->placement.empty()) return;
  const double by_touches = held_out_error(Scorer(plain)).points.mean;
  if (!(by_touches > 0.0)) return;
  for (Candidate& candidate : out.candidates)
    for (ErrorStats* stats : {&candidate.alone, &candidate.after})
      *stats = scaled(*stats, out.before.mean / by_touches);
}

/// Formulas for structure that this model leaves.
std::vector<FormulaOffer> offers(const Work& w, const std::vector<EffectEntry>& effects,
                                 const Calibration& fitted, const HeldOutPredictions& before,
                                 const UnknownStructure& unknown) {
  if (unknown.instead) return {};  // it stands behind an effect that is in this model
  return formula_offers({w.cell, w.measured, w.split, w.choosing, w.fit, effects, fitted, before,
                         w.bad, unknown.pattern,
                         [&w](const std::vector<EffectEntry>& with, const Calibration& from) {
                           return held_out_of(w, with, from);
                         }});
}

/// @param present, before  The model at the start, fitted to all poses, and what it predicts.
void go_all_the_way(const Work& w, const Calibration& base, const WhitenedFit& whitened,
                    const Scan& first, const Calibration& present, const HeldOutPredictions& before,
                    Diagnosis& out) {
  ForwardSelection found = forward_selection(w.start(w.choosing, false), base, whitened, first);
  std::vector<HeldOutPredictions> held_by_step;
  for (const auto& step : found.steps) {
    held_by_step.push_back(held_out_of(w, step.effects, step.calibration));
    out.added.push_back({step.entry, step.cycles, step.peaks, step.ln_bayes,
                         held_by_step.back().stats(w.bad), step.alternatives, step.moves,
                         held_by_step.back().turn_stats(), step.sizes});
  }
  std::optional<HeldOutPredictions> nested;
  if (chosen_in_folds(w, found.steps)) nested = nested_held_out(w);
  const auto error_of = [&w](const HeldOutPredictions& held) {
    return HeldOutError{held.stats(w.bad), held.turn_stats()};
  };
  const bool rises = nested && rises_over(out, error_of(*nested));
  const std::size_t kept = rises ? 0 : steps_kept(out);
  const bool refused = kept < out.added.size();
  // Where only what was found beside an undecided finding is refused, that finding is left.
  const bool undecided_is_left = refused && found.at_first && kept >= found.at_first->steps;
  if (rises && !undecided_is_left) {
    out.refused = nested->stats(w.bad);
    if (out.turns) out.turns->refused = nested->turn_stats();
  }
  if (refused) {
    out.remarks.push_back(
        refusal(w.cell, out, kept, rises ? error_of(*nested) : error_after(out, kept + 1)));
    out.added.erase(out.added.begin() + static_cast<std::ptrdiff_t>(kept), out.added.end());
    found.steps.erase(found.steps.begin() + static_cast<std::ptrdiff_t>(kept), found.steps.end());
    held_by_step.erase(held_by_step.begin() + static_cast<std::ptrdiff_t>(kept),
                       held_by_step.end());
    found.unlikely.clear();
  }
  if (!found.steps.empty() && !w.all_choose()) {
    fit_to_all(w, found.steps);
    held_by_step.back() =
        held_out_of(w, found.steps.back().effects, found.steps.back().calibration);
    for (std::size_t i = 0; i < found.steps.size(); ++i) {
      out.added[i].entry = found.steps[i].entry;
      out.added[i].moves = found.steps[i].moves;
    }
    out.added.back().held = held_by_step.back().stats(w.bad);
    out.added.back().turns = held_by_step.back().turn_stats();
  }
  std::optional<HeldOutPredictions> held;
  if (!held_by_step.empty()) held = std::move(held_by_step.back());
  out.full = found.full;
  if (!refused) out.undecided = found.undecided;
  if (undecided_is_left) out.undecided = found.at_first->undecided;
  out.unlikely = found.unlikely;
  say_what_was_not_judged(found, out);
  if (!found.steps.empty()) {
    out.effects = found.steps.back().effects;
    Cell with = w.cell;
    with.effects = out.effects;
    const Calibration& fitted = found.steps.back().calibration;
    out.repeatability = repeatability(with, w.measured, fitted.state, fitted.parameters,
                                      without_outliers(w.fit, fitted.outliers));
    // If the model is full but more effects are supported, the scatter left is not repeatability.
    if (found.full) out.repeatability = {};
    out.floor =
        with_repeatability(noise_floor(w.cell, w.measured, fitted.state), out.repeatability);
  }
  if (found.unknown)
    out.formulas =
        offers(w, out.effects, found.steps.empty() ? present : found.steps.back().calibration,
               held ? *held : before, *found.unknown);
  if (nested && kept > 0) {
    out.nested = true;
    held = std::move(nested);
  }
  if (held) {
    out.after = held->stats(w.bad);
    const Calibration& fitted = found.steps.empty() ? base : found.steps.back().calibration;
    out.held_out_excess = held_out_excess_of(w, *held, fitted, out.floor);
    if (out.turns) judge_turns(w, *held, fitted, *out.turns);
  }
  out.unknown_after = found.unknown;
}

bool far_above_the_noise(const Diagnosis& d) {
  return (d.held_out_excess && d.held_out_excess->lack_of_fit()) || turned(d);
}

/// The facts after the effects were added: supported laws are now in the model, so of these only
/// the doubtful ones count.
Facts facts_after(const Facts& before, const Diagnosis& d) {
  const auto not_shown = [](const Addition& a) { return names_what_is_not_shown(a.alternatives); };
  return {.judgeable = before.judgeable,
          .wrong_gravity = d.gravity && d.gravity->certain,
          .structure = d.unknown_after.has_value(),
          .law_not_shown = std::any_of(d.added.begin(), d.added.end(), not_shown),
          .tied = d.tied.has_value(),
          .other_fate = d.undecided.has_value(),
          .noise_known = before.noise_known,
          .excess = far_above_the_noise(d)};
}

}  // namespace

Diagnosis diagnose(const Cell& cell, const MeasurementFiles& measured,
                   const DiagnosisRequest& request) {
  Work w{as_judged(physics_of(cell), measured),
         measured,
         split_poses(measured, cell.measurement.held_out, cell.measurement.seed),
         {},
         {},
         {},
         {},
         {},
         {},
         request};
  w.fit = fit_rows(w.split);
  w.choosing = even_choice(measured, w.fit, kMostChoosing, cell.measurement.seed);
  if (w.split.folds == 0) w.held = held_rows(w.split);
  w.testable = testable_effects(data_sense(w.cell, measured, w.fit));
  Diagnosis out;
  for (const auto& answer : w.testable)
    if (answer.answer == Testable::Answer::kNo) {
      w.not_testable.push_back(answer.effect);
      if (!arm_can_have(w.cell, answer.effect)) continue;  // no measurement could help
      out.not_testable.push_back(answer);
      w.excluded.push_back(answer);
    }
  tell_step(request, 0);
  Looked seen = looked(w, w.cell);
  if (judgeable(seen.at.whitened))
    if (auto turned = gravity_by_points(w, seen)) {
      out.gravity = turned->gravity;
      if (turned->gravity.certain) look_under(*std::move(turned), w, seen);
    }
  const Calibration& base = seen.base;
  const WhitenedFit& plain = seen.plain;
  JudgedFit& at = seen.at;
  const WhitenedFit& whitened = at.whitened;
  if (judgeable(whitened)) add_series_of_all(whitened, base, w.not_testable, at.look);
  const Scan& first = at.look;
  const Calibration present =
      w.all_choose() ? base : calibrate_from(w.cell, measured, w.fit, base.state);
  out.repeatability = at.repeatability;
  out.floor = with_repeatability(noise_floor(w.cell, measured, present.state), out.repeatability);
  out.folds = w.split.folds;
  out.poses_fit = static_cast<int>(w.fit.size());
  out.poses_held = static_cast<int>(held_rows(w.split).size());
  out.poses_choosing = static_cast<int>(w.choosing.size());
  out.regressors = first.regressors;
  for (const auto& outlier : present.outliers) out.outliers.push_back(measured.pose[outlier.row]);
  Facts facts = facts_of(first, whitened, base);
  out.candidates = candidates_of(whitened, plain, first);
  if (decide(facts) == Finding::kMissing) {
    out.alternatives = alternatives(whitened, first, *first.supported(), w.excluded);
    if (const auto slow =
            slow_motion_instead_of(whitened, first, *first.supported(), out.alternatives))
      out.slow_motion = unknown_structure(whitened, *slow);
    facts.law_not_shown = names_what_is_not_shown(out.alternatives);
    facts.slow_motion = out.slow_motion.has_value();
  }
  if (const Found* other =
          decide(facts) == Finding::kMissing ? tied_with_first(whitened, first) : nullptr)
    out.tied = other->entry;
  facts.tied = out.tied.has_value();
  if (decide(facts) == Finding::kUnknown) out.unknown = unknown_structure(whitened, *first.pattern);
  const bool wrong_gravity = out.gravity && out.gravity->certain;
  facts.other_gravity = out.gravity && !wrong_gravity;
  tell_step(request, 2);
  const HeldOutPredictions held = held_out_of(w, w.cell.effects, present);
  w.bad.sigma_m = out.floor.sigma_m;
  w.bad.rows = held.bad_rows(w.bad.sigma_m);
  out.before = out.after = held.stats(w.bad);
  as_by_placements(seen.plain, out);
  out.held_out_excess = held_out_excess_of(w, held, present, out.floor);
  if (seen.plain.turns()) {
    const OrientationFloor floor = orientation_floor(cell, measured);
    out.turns = FoundTurns{floor, held.turn_stats(), {}, {}, {}};
    judge_turns(w, held, present, *out.turns);
  }
  out.effects = w.cell.effects;
  if (request.apply) tell_step(request, 3);
  if (request.apply && !wrong_gravity) go_all_the_way(w, base, whitened, first, present, held, out);
  take_over_first(out);
  facts.refused = out.refused.has_value();
  facts.excess = far_above_the_noise(out);
  out.finding = decide(facts);
  if (request.apply) out.finding_after = decide(facts_after(facts, out));
  if (!request.apply && out.finding == Finding::kUnknown && !out.gravity)
    out.formulas = offers(w, w.cell.effects, present, held, *out.unknown);
  if (out.finding_after && out.finding_after != Finding::kUnknown) out.formulas.clear();
  out.text = verdict_text(w.cell, out);
  out.text_after = verdict_after_text(w.cell, out);
  return out;
}

}  // namespace plumb::offline
