// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/claims.hpp"

#include <algorithm>

#include "diagnose/left_beside.hpp"
#include "simulate/law.hpp"
#include "tests/blind/answer.hpp"

namespace plumb::tests {
namespace {

using offline::Diagnosis;
using offline::EffectEntry;
using offline::Finding;

bool is_hidden(const HiddenCase& drawn, const EffectEntry& entry) {
  return std::any_of(drawn.hidden.begin(), drawn.hidden.end(),
                     [&](const auto& hidden) { return is_like(hidden, entry); });
}

bool is_related(const HiddenCase& drawn, const EffectEntry& entry) {
  if (std::find(drawn.related.begin(), drawn.related.end(), entry.name) != drawn.related.end())
    return true;
  return std::any_of(drawn.hidden.begin(), drawn.hidden.end(),
                     [&](const auto& hidden) { return tests::is_related(hidden, entry); });
}

/// An addition says what it may be instead, where these poses cannot tell.
bool is_related(const HiddenCase& drawn, const offline::Addition& added) {
  return is_related(drawn, added.entry) ||
         std::any_of(added.alternatives.begin(), added.alternatives.end(),
                     [&](const auto& other) { return is_hidden(drawn, other.entry); });
}

/// What the first candidate may be instead, as the verdict says: "A or B".
template <class Verdict>
std::vector<EffectEntry> alternatives_of(const Verdict& d) {
  std::vector<EffectEntry> out;
  if (d.tied) out.push_back(*d.tied);
  // Once a diagnosis lists them: those of the first candidate.
  if constexpr (requires { d.alternatives.front().entry; })
    for (const auto& other : d.alternatives) out.push_back(other.entry);
  return out;
}

/// New poses of the arm show what is hidden in it: nothing that happened to the measurement.
bool acts_on_new_poses(const HiddenCase& drawn) {
  using Domain = offline::sim::LawEntry::Domain;
  return std::all_of(drawn.hidden.begin(), drawn.hidden.end(), [](const auto& hidden) {
    const Domain domain = offline::sim::find_law(hidden.law)->domain;
    return domain == Domain::kRobot || domain == Domain::kEnvironment;
  });
}

}  // namespace

Claims claims_of(const HiddenCase& drawn, const Diagnosis& d) {
  Claims out;
  const auto others = alternatives_of(d);
  out.slow_motion = d.slow_motion.has_value();
  out.turned_gravity = d.gravity && d.gravity->certain;
  out.either = !others.empty() || d.slow_motion;
  out.alarm = d.finding == Finding::kMissing || d.finding == Finding::kUnknown || out.either ||
              !d.added.empty() || d.unknown_after.has_value();
  out.first_doubtful = offline::part_of_first(d) != offline::PartOf::kNothing;
  for (const auto& added : d.added) {
    const bool certain = offline::part_of(d, added) == offline::PartOf::kNothing;
    out.unrelated += !is_related(drawn, added);
    out.unrelated_certain += certain && !is_related(drawn, added);
    out.doubtful_right += !certain && is_hidden(drawn, added.entry);
  }
  if (d.candidates.empty()) return out;
  const auto& first = d.candidates.front();
  out.lead =
      first.ln_bayes - (d.candidates.size() > 1 ? std::max(d.candidates[1].ln_bayes, 0.0) : 0.0);
  out.first_right = d.finding == Finding::kMissing && is_hidden(drawn, first.entry);
  out.either_right =
      out.either && (is_hidden(drawn, first.entry) ||
                     std::any_of(others.begin(), others.end(),
                                 [&](const auto& other) { return is_hidden(drawn, other); }));
  out.fall_counts = d.finding == Finding::kMissing && first.supported && acts_on_new_poses(drawn) &&
                    (first.domain == "robot" || first.domain == "environment");
  out.fall = first.gain;
  out.fall_se = first.gain_se;
  return out;
}

}  // namespace plumb::tests
