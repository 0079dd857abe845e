// SPDX-License-Identifier: Apache-2.0
#include "diagnose/exchange.hpp"

#include <algorithm>
#include <set>

#include "cell/effects_edit.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/evidence_without.hpp"
#include "diagnose/found_list.hpp"
#include "diagnose/model_parts.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

bool same_places(const Found& a, const Found& b) {
  const auto a_entries = a.entries(), b_entries = b.entries();
  return std::equal(a_entries.begin(), a_entries.end(), b_entries.begin(), b_entries.end(),
                    same_effect);
}

/// The same step with other moves, if these explain more: an effect that was added later may be the
/// true cause of one of the moves. Null if no other moves are better.
const Found* moves_otherwise(const Selection& s, const JudgedModel& without, const Found& found) {
  if (!is_change_point(found.entry.name)) return nullptr;
  const Found* again = without.look.find(s.cell(), s.key(found.entry));
  const bool better = again != nullptr && again->score > kSupported &&
                      !same_places(*again, found) &&
                      again->ln_bayes() > evidence_as_it_is(without, found);
  return better ? again : nullptr;
}

/// An effect that replaces this one better, in the model without it; or null.
const Found* better_than(const Selection& s, const JudgedModel& without, const Found& found) {
  if (const Found* again = moves_otherwise(s, without, found)) return again;
  const Found* other = without.look.supported();
  if (other == nullptr || s.key(other->entry) == s.key(found.entry) || s.is_open(other->entry))
    return nullptr;
  return other->ln_bayes() < evidence_without(without, found) + kSupported ? nullptr : other;
}

std::optional<Proposal> better_one(const Selection& s, const Found& found) {
  // A step is banned once one of its moves was dropped. Here all its moves are searched again.
  std::vector<std::string> banned = s.banned();
  if (is_change_point(found.entry.name)) std::erase(banned, s.key(found.entry));
  const JudgedModel without = s.without(found.entries(), banned);
  const Found* other = better_than(s, without, found);
  if (other == nullptr) return std::nullopt;
  return Proposal{.model = s.fitted(with_found(without.model.cell->effects, *other)),
                  .out = found.entries(),
                  .in = {*other},
                  .instead = s.alternatives_in(without, *other)};
}

/// Number of effects of the model; several waves or moves of one part count as one. A step is tried
/// again whenever this number changes.
std::size_t findings_in(const Selection& s) {
  std::set<std::string> out;
  for (const EffectEntry& e : s.cell().effects) out.insert(s.key(e));
  return out.size();
}

/// Whether the exchange is to be tried. Not for waves: fresh_waves.hpp searches all of a joint
/// again.
bool is_due_for_exchange(Selection& s, const char* name, const Found& found) {
  const EffectEntry& entry = found.entry;
  const std::string key = s.key(entry);
  if (is_wave(entry.name) || is_series(entry.name)) return false;
  if (is_change_point(entry.name)) return s.first_time("rank of a step", key, findings_in(s));
  return s.times(name) < kMostExchanges && s.first_time(name, key);
}

bool is_oversized(const Cell& cell, const WhitenedFit& whitened, const Calibration& calibration,
                  const std::vector<EffectEntry>& given, const EffectEntry& entry) {
  const auto all = oversized(cell, whitened, calibration, given);
  return std::any_of(all.begin(), all.end(),
                     [&](const Oversized& one) { return one.entry.name == entry.name; });
}

std::vector<Found> of_unusual_size(const Selection& s) {
  std::vector<Found> out;
  for (auto& one : oversized(s.cell(), s.whitened(), s.calibration(), s.start().cell.effects))
    if (!is_wave(one.entry.name) && !is_series(one.entry.name))
      out.emplace_back().entry = std::move(one.entry);
  return out;
}

std::optional<Proposal> one_of_usual_size(const Selection& s, const Found& found) {
  const EffectEntry& entry = found.entry;
  const JudgedModel without = s.without(entry, s.banned());
  const Found* own = without.look.find(s.cell(), s.key(entry));
  const Found* other = without.look.supported(
      [&](const Found& f) { return f.entry.name != entry.name || f.entry.joints != entry.joints; });
  if (own == nullptr || other == nullptr || s.is_open(other->entry) ||
      other->ln_bayes() < own->ln_bayes() - kTold_nats)
    return std::nullopt;
  FittedModel next = s.fitted(with_found(without.model.cell->effects, *other));
  WhitenedFit whitened = s.whitened_fit_of(next);
  if (is_oversized(*next.cell, whitened, next.calibration, s.start().cell.effects, other->entry))
    return std::nullopt;
  return Proposal{.model = std::move(next),
                  .whitened = std::move(whitened),
                  .out = {entry},
                  .in = {*other},
                  .instead = s.alternatives_in(without, *other)};
}

/// The added effects; none if there is only one, because nothing has been added since.
std::vector<Found> if_several(const Selection& s) {
  return s.added.size() < 2 ? std::vector<Found>() : s.added;
}

}  // namespace

const Revision kExchange{
    .name = "exchange", .subjects = if_several, .proposal = better_one, .due = is_due_for_exchange};

const Revision kExchangeForSize{
    .name = "exchange for size", .subjects = of_unusual_size, .proposal = one_of_usual_size};

}  // namespace plumb::offline
