// SPDX-License-Identifier: Apache-2.0
#include "diagnose/imitating_step.hpp"

#include "diagnose/constants.hpp"
#include "diagnose/evidence_without.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

bool of_the_same_part(const std::optional<Found>& a, const std::optional<Found>& b) {
  return a && b && a->pattern.subject == b->pattern.subject;
}

std::vector<Found> added_steps(const Selection& s) {
  std::vector<Found> out;
  for (const Found& found : s.added)
    if (is_change_point(found.entry.name)) out.push_back(found);
  return out;
}

std::optional<Proposal> model_without(const Selection& s, const Found& step) {
  JudgedModel without = s.without(step.entries(), s.banned());
  const auto& pattern = without.look.pattern;
  if (!of_the_same_part(pattern, s.look().pattern) ||
      pattern->ln_bayes() < evidence_without(without, step) + kAhead_nats)
    return std::nullopt;
  return Proposal{
      .model = std::move(without), .out = step.entries(), .banned = {s.key(step.entry)}};
}

}  // namespace

const Revision kImitatingStep{.name = "imitating step",
                              .subjects = added_steps,
                              .proposal = model_without,
                              .due = [](Selection&, const char*, const Found&) { return true; }};

}  // namespace plumb::offline
