// SPDX-License-Identifier: Apache-2.0
#include "diagnose/certainty.hpp"

#include <algorithm>

#include "cell/effects_edit.hpp"
#include "diagnose/alternatives.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/few_digits.hpp"

namespace plumb::offline {
namespace {

/// The candidate of that key, if the evidence hardly sets it apart from the first; or null.
const Candidate* near_rival_of_key(const Cell& cell, const Diagnosis& d, const std::string& key) {
  const auto found =
      std::find_if(d.candidates.begin(), d.candidates.end(), [&](const Candidate& other) {
        return key == key_of(cell, other.entry) &&
               d.candidates.front().ln_bayes - other.ln_bayes < kCertain_nats;
      });
  return found == d.candidates.end() ? nullptr : &*found;
}

/// Of a diagnosis that ends with a first candidate which is not in the model.
Certainty of_candidate(const Cell& cell, const Diagnosis& d) {
  const Candidate& best = d.candidates.front();
  if (!helps(d, best) || d.refused) return Certainty::kDoubtful;
  if (d.tied || may_be_another(d) || near_rival(cell, d) != nullptr) return Certainty::kAOrB;
  if (d.gravity && !d.gravity->certain) return Certainty::kAOrB;
  return explains_little(d) || !best.plausible || nats_ahead(cell, d) < kCertain_nats
             ? Certainty::kDoubtful
             : Certainty::kCertain;
}

/// What is left after effects were added.
Certainty after_apply(const Diagnosis& d) {
  switch (*d.finding_after) {
    case Finding::kUnknown:
      return Certainty::kDoubtful;
    case Finding::kUndecidable:
      return d.undecided || d.tied ? Certainty::kAOrB : Certainty::kNothing;
    default:
      return Certainty::kNothing;
  }
}

}  // namespace

const char* name_of(Certainty certainty) {
  switch (certainty) {
    case Certainty::kCertain:
      return "certain";
    case Certainty::kAOrB:
      return "a_or_b";
    case Certainty::kDoubtful:
      return "doubtful";
    case Certainty::kNothing:
      break;
  }
  return "nothing";
}

Certainty certainty(const Cell& cell, const Diagnosis& d) {
  if (d.gravity && d.gravity->certain) return Certainty::kCertain;
  if (d.finding_after) return after_apply(d);
  switch (d.finding) {
    case Finding::kMissing:
      return of_candidate(cell, d);
    case Finding::kUnknown:
      return Certainty::kDoubtful;
    case Finding::kUndecidable: {
      const bool of_a_law = d.tied || may_be_another(d) || d.refused || d.gravity;
      return of_a_law && !d.candidates.empty() ? of_candidate(cell, d) : Certainty::kNothing;
    }
    case Finding::kComplete:
      break;
  }
  return Certainty::kNothing;
}

bool falls(double before_m, double after_m) {
  return digits_mm(after_m) != digits_mm(before_m) && after_m < before_m;
}

bool helps(const Diagnosis& d, const Candidate& c) {
  if (falls(d.before.mean, c.alone.mean)) return true;
  return d.turns && c.alone_turns.n > 0 && c.alone_turns.mean < kTurnsFall * d.turns->before.mean &&
         c.alone.mean <= kMostRise * d.before.mean;
}

bool turned(const Diagnosis& d) {
  return d.turns && d.turns->excess && d.turns->excess->lack_of_fit();
}

bool explains_little(const Diagnosis& d) {
  const double after_m = d.candidates.front().alone.mean;
  return d.floor.source != NoiseFloor::Source::kNone &&
         after_m > kFarAboveFloor * d.floor.mean_m * d.floor.inferred_times() &&
         after_m > (1.0 - kLittleShare) * d.before.mean;
}

bool may_be_another(const Diagnosis& d) { return !d.alternatives.empty() || d.slow_motion; }

bool is_either(const Diagnosis& d, const EffectEntry& entry) {
  if (!may_be_another(d)) return false;
  return same_effect(d.candidates.front().entry, entry) ||
         std::any_of(d.alternatives.begin(), d.alternatives.end(),
                     [&](const Alternative& other) { return same_effect(other.entry, entry); });
}

bool is_near_rival(const Cell& cell, const Diagnosis& d, const std::string& key) {
  return near_rival_of_key(cell, d, key) != nullptr;
}

const Candidate* near_rival(const Cell& cell, const Diagnosis& d) {
  for (const auto& key : d.candidates.front().confounded_with)
    if (const Candidate* rival = near_rival_of_key(cell, d, key)) return rival;
  return nullptr;
}

double nats_ahead(const Cell& cell, const Diagnosis& d) {
  const Candidate& best = d.candidates.front();
  const Candidate* const rival = near_rival(cell, d);
  return rival == nullptr ? best.ln_bayes
                          : std::min(best.ln_bayes, best.ln_bayes - rival->ln_bayes);
}

}  // namespace plumb::offline
