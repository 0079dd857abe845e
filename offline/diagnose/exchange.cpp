// SPDX-License-Identifier: Apache-2.0
#include "diagnose/exchange.hpp"

#include "diagnose/constants.hpp"
#include "diagnose/found_list.hpp"
#include "diagnose/unless_refused.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

/// An effect that replaces `key` better, in the model without it; or null.
const Found* better_than(const Selection& s, const JudgedModel& without, const std::string& key) {
  const Found* other = without.look.supported();
  if (other == nullptr || s.key(other->entry) == key) return nullptr;
  const Found* own = without.look.find(s.cell(), key);
  const bool hardly = own != nullptr && other->ln_bayes() < own->ln_bayes() + kSupported;
  return hardly ? nullptr : other;
}

bool exchange_one(Selection& s, const EffectEntry& entry) {
  const JudgedModel without = s.without(entry, s.banned());
  const Found* other = better_than(s, without, s.key(entry));
  if (other == nullptr) return false;
  s.look_at(s.fitted(with_found(without.model.cell->effects, *other)));
  forget(s.added, entry);
  s.added.push_back(*other);
  return true;
}

}  // namespace

bool exchange(Selection& s) {
  if (s.added.size() < 2) return false;
  for (const Found& found : std::vector<Found>(s.added)) {
    if (is_wave(found.entry.name) || is_series(found.entry.name) ||
        s.exchanged.contains(s.key(found.entry)) || s.exchanged.size() >= kMostExchanges)
      continue;
    s.exchanged.insert(s.key(found.entry));
    bool done = false;
    if (!unless_refused([&] { done = exchange_one(s, found.entry); }))
      s.not_compared_without(found.entry);
    if (done) return true;
  }
  return false;
}

}  // namespace plumb::offline
