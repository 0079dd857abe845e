// SPDX-License-Identifier: Apache-2.0
#include "diagnose/beside_undecided.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "diagnose/constants.hpp"
#include "diagnose/effect_domain.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/found_list.hpp"
#include "diagnose/model_parts.hpp"
#include "diagnose/unless_refused.hpp"

namespace plumb::offline {
namespace {

std::vector<EffectEntry> findings_of(const Undecided& undecided) {
  std::vector<EffectEntry> out{undecided.entry};
  for (const auto& other : undecided.alternatives) out.push_back(other.entry);
  return out;
}

/// Whether one candidate imitates more than another: by more numbers, or by as many and as one of
/// the measurement.
bool is_wider(const Found& a, const Found& b) {
  const auto width = [](const Found& found) {
    return std::pair(found.scored.theta.size(), !is_compiled(found.entry));
  };
  return width(a) > width(b);
}

/// The widest of the alternatives; those that these data cannot show are none of the scan. Nothing
/// where the model has no room for it.
std::optional<Found> nuisance_for(const Selection& s, const Undecided& undecided) {
  const Found* out = nullptr;
  for (const EffectEntry& entry : findings_of(undecided)) {
    const Found* found = s.look().find(s.cell(), s.key(entry));
    if (found != nullptr && (out == nullptr || is_wider(*found, *out))) out = found;
  }
  if (out == nullptr || s.cell().effects.size() + out->entries().size() > kMostEffects)
    return std::nullopt;
  return *out;
}

/// The selection beside the nuisances, at its end.
Selection searched_beside(Selection s, Undecided undecided, const SearchOn& search) {
  for (int i = 0; i < kMostCarried; ++i) {
    s.leave_open(findings_of(undecided));
    const auto nuisance = nuisance_for(s, undecided);
    if (!nuisance || !unless_refused([&] { s.carry(*nuisance); })) break;
    auto next = search(s);
    if (!next) break;
    undecided = std::move(*next);
  }
  return s;
}

/// Whether a selection has added an effect that another one has not.
bool has_more(const Selection& s, const Selection& than) {
  std::set<std::string> known;
  for (const Found& found : than.added) known.insert(than.key(found.entry));
  return std::any_of(s.added.begin(), s.added.end(),
                     [&](const Found& found) { return !known.contains(s.key(found.entry)); });
}

std::vector<EffectEntry> less_nuisances(const Selection& s) {
  std::vector<EffectEntry> out = s.cell().effects;
  for (const EffectEntry& entry : s.carried()) out = without_effect(std::move(out), entry);
  return out;
}

/// Removes what has no evidence in the model without the nuisances.
void drop_what_has_none(Selection& s) {
  while (const auto weak =
             lost(s.cell(), s.whitened(), s.calibration(), s.start().cell.effects, {})) {
    s.look_at(s.fitted_somehow(without_effect(s.cell().effects, *weak)));
    forget(s.added, *weak);
  }
}

/// Stands at the model that was found beside the nuisances, without these.
void take_over(Selection& s, const Selection& beside) {
  Proposal all{.model = s.fitted_somehow(less_nuisances(beside)), .in = beside.added};
  for (const Found& found : s.added)
    for (auto& entry : found.entries()) all.out.push_back(std::move(entry));
  s.take(std::move(all));
  for (const Found& found : s.added) {
    const std::string key = s.key(found.entry);
    s.remember_alternatives(key, beside.alternatives_of(key));
  }
  drop_what_has_none(s);
}

}  // namespace

std::optional<Selection> with_what_is_beside(const Selection& selection, const Undecided& undecided,
                                             const SearchOn& search) {
  const Selection beside = searched_beside(selection, undecided, search);
  if (!has_more(beside, selection)) return std::nullopt;
  Selection out = selection;
  out.leave_open(beside.open());
  if (!unless_refused([&] { take_over(out, beside); }) || !has_more(out, selection))
    return std::nullopt;
  return out;
}

}  // namespace plumb::offline
