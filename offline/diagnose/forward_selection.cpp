// SPDX-License-Identifier: Apache-2.0
#include "diagnose/forward_selection.hpp"

#include <algorithm>

#include "cell/effects_edit.hpp"
#include "diagnose/add_effect.hpp"
#include "diagnose/alternatives.hpp"
#include "diagnose/behind_oversized.hpp"
#include "diagnose/beside_undecided.hpp"
#include "diagnose/candidates.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/doubt.hpp"
#include "diagnose/effect_domain.hpp"
#include "diagnose/exchange.hpp"
#include "diagnose/found_list.hpp"
#include "diagnose/fresh_waves.hpp"
#include "diagnose/imitating_step.hpp"
#include "diagnose/left_out_ends.hpp"
#include "diagnose/series_of_all.hpp"
#include "diagnose/unless_refused.hpp"
#include "effects/effect_option.hpp"

namespace plumb::offline {
namespace {

/// The candidate with no more waves or moves than the model has room for. Waves are sorted, the
/// strongest first.
Found as_many_as_fit(const Selection& s, Found found) {
  const std::size_t room = kMostEffects - std::min(kMostEffects, s.cell().effects.size());
  if (found.cycles.size() > room) found.cycles.resize(room);
  if (found.moves.size() > room) found.moves.resize(room);
  return found;
}

/// Whether an effect may be added. Of several that these poses cannot tell apart the first is added
/// where all share its fate, since the prediction is as good with any of them. Where some would be
/// compiled and others thrown away, it would be a guess about the arm; so would be a step in place
/// of a slow motion. Beside one of them that is carried as a nuisance, the others stay open too.
bool may_be_added(Selection& s, const Found& best, ForwardSelection& out) {
  auto others = alternatives(s.whitened(), s.look(), best, s.start().excluded);
  const bool beside_itself = !s.carried().empty() && s.is_open(best.entry);
  if (beside_itself || of_different_fate(best.entry, others)) {
    out.undecided = Undecided{best.entry, best.cycles, domain_word(best.entry), std::move(others)};
    return false;
  }
  if (const auto slow = slow_motion_instead_of(s.whitened(), s.look(), best, others)) {
    out.undecided = Undecided{best.entry,
                              best.cycles,
                              domain_word(best.entry),
                              {},
                              unknown_structure(s.whitened(), *slow)};
    return false;
  }
  s.remember_alternatives(s.key(best.entry), std::move(others));
  return true;
}

/// Tries these in their order until one has changed the model.
bool revise_once(Selection& s, std::initializer_list<const Revision*> revisions) {
  return std::any_of(revisions.begin(), revisions.end(),
                     [&](const Revision* revision) { return revise(s, *revision); });
}

/// What the selection ends with by itself: unknown structure, a full model, or nothing more.
void select(Selection& s, ForwardSelection& out) {
  for (int step = 0; step < kMostSteps; ++step) {
    if (s.look().unknown() && !s.leaves_as_remainder(*s.look().pattern)) {
      // Unknown structure is concluded last: it may be the residual of a wrongly named effect.
      if (revise_once(s, {&kLeftOutEnds, &kExchangeForSize, &kExchange, &kImitatingStep})) continue;
      out.unknown = unknown_structure(s.whitened(), *s.look().pattern);
      return;
    }
    const Found* best =
        s.look().supported([&](const Found& f) { return !s.leaves_as_remainder(f); });
    out.full = best != nullptr && s.cell().effects.size() >= kMostEffects;
    if (out.full) return;
    out.undecided.reset();
    if (best != nullptr && may_be_added(s, *best, out))
      add_effect(s, as_many_as_fit(s, with_fresh_waves(s, *best)));
    else if (!revise_once(s, {&kExchange, &kDoubt, &kExchangeForSize, &kLeftOutEnds}) &&
             (best != nullptr || !revise_once(s, {&kSeriesOfAll})))
      return;
  }
}

/// What it ended at, if that was undecided.
std::optional<Undecided> open_end(const ForwardSelection& ended) {
  return ended.unknown || ended.full ? std::nullopt : ended.undecided;
}

/// Selects until nothing more is found, neither by itself nor beside what stays undecided.
Selection searched(Selection s, ForwardSelection& out, int rounds) {
  select(s, out);
  const std::optional<Undecided> open = open_end(out);
  if (!open || rounds == 0) return s;
  std::optional<Selection> more = with_what_is_beside(s, *open, [](Selection& beside) {
    ForwardSelection there;
    select(beside, there);
    return open_end(there);
  });
  if (!more) return s;
  if (!out.at_first) out.at_first = {*open, s.added.size()};
  out.undecided.reset();
  return searched(std::move(*more), out, rounds - 1);
}

bool same(const std::vector<EffectEntry>& a, const std::vector<EffectEntry>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_effect);
}

/// The model after one step. Most were fitted already during the selection.
Calibration calibration_of(const Selection& s, const std::vector<EffectEntry>& effects) {
  if (same(effects, s.cell().effects)) return s.calibration();
  for (const auto& model : s.seen())
    if (same(effects, model.cell->effects)) return model.calibration;
  return s.fitted_somehow(effects).calibration;
}

/// The effects one by one, each with the model as it was then.
std::vector<ForwardStep> steps(Selection& s) {
  std::vector<ForwardStep> out;
  auto effects = s.start().cell.effects;
  for (const auto& found : s.added) {
    effects = with_found(std::move(effects), found);
    const bool last = out.size() + 1 == s.added.size();
    EffectEntry entry = found.entry;
    if (!found.cycles.empty()) set_option(entry, OptionKey::kCyclesPerTurn, found.cycles.front());
    out.push_back({entry,
                   found.cycles,
                   found.peaks,
                   found.moves,
                   found.sizes,
                   found.ln_bayes(),
                   s.alternatives_of(s.key(found.entry)),
                   last ? s.cell().effects : effects,
                   {}});
  }
  if (out.empty()) return out;
  if (!unless_refused([&] { s.refit_fully(); })) s.not_refitted_from_the_start();
  // The intermediate models are only fitted after the selection has ended.
  for (auto& step : out) step.calibration = calibration_of(s, step.effects);
  return out;
}

}  // namespace

ForwardSelection forward_selection(const ForwardStart& start, const Calibration& calibration,
                                   WhitenedFit whitened, const Scan& first) {
  ForwardSelection out;
  Selection selection =
      searched(Selection(start, calibration, std::move(whitened), first), out, kMostBesideSearches);
  if (!out.unknown) out.unknown = behind_oversized(selection, out.unlikely);
  out.steps = steps(selection);
  out.not_judged = selection.not_judged();
  return out;
}

}  // namespace plumb::offline
