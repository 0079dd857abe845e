// SPDX-License-Identifier: Apache-2.0
#include "diagnose/give_way.hpp"

#include "diagnose/constants.hpp"
#include "diagnose/evidence_without.hpp"
#include "diagnose/found_list.hpp"
#include "diagnose/unless_refused.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

bool of_the_same_part(const std::optional<Found>& a, const std::optional<Found>& b) {
  return a && b && a->pattern.subject == b->pattern.subject;
}

bool gives_way(Selection& s, const Found& step) {
  JudgedModel without = s.without(step.entries(), s.banned());
  const auto& pattern = without.look.pattern;
  if (!of_the_same_part(pattern, s.look().pattern) ||
      pattern->ln_bayes() < evidence_without(without, step) + kAhead_nats)
    return false;
  for (const auto& entry : step.entries()) forget(s.added, entry);
  s.ban(s.key(step.entry));
  s.go_to(std::move(without));
  s.look_again();
  return true;
}

}  // namespace

bool step_gives_way(Selection& s) {
  for (const Found& found : std::vector<Found>(s.added)) {
    if (!is_change_point(found.entry.name)) continue;
    bool done = false;
    if (!unless_refused([&] { done = gives_way(s, found); })) s.not_compared_without(found.entry);
    if (done) return true;
  }
  return false;
}

}  // namespace plumb::offline
