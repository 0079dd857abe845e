// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/diagnosis.hpp"

namespace plumb::offline {

/// How sure it is why a model misses. Every screen shows it beside the sentence of the diagnosis,
/// and the sentence follows the same decisions.
enum class Certainty {
  kCertain,   // one effect is missing, and the evidence sets it apart from any other
  kAOrB,      // these poses cannot tell it from another cause
  kDoubtful,  // something is there, but its cause or its size is in doubt
  kNothing    // nothing is found, or nothing that these poses could name
};
const char* name_of(Certainty certainty);  // "certain", "a_or_b", "doubtful", "nothing"

/// Of the last finding of a diagnosis: with `apply`, of what is still missing after it.
Certainty certainty(const Cell& cell, const Diagnosis& diagnosis);

/// Whether the error on unseen poses falls, in the digits that are shown.
bool falls(double before_m, double after_m);

/// Whether the first candidate may be another effect, or a slow motion, instead.
bool may_be_another(const Diagnosis& diagnosis);

/// Whether an effect is the first candidate or one of what it may be instead.
bool is_either(const Diagnosis& diagnosis, const EffectEntry& entry);

/// Whether another effect, known by its key, explains these poses nearly as well as the first
/// candidate: the evidence hardly sets them apart.
bool is_near_rival(const Cell& cell, const Diagnosis& diagnosis, const std::string& key);

/// The first that does nearly what the first candidate does, and that the evidence hardly sets
/// apart; null if nothing is near.
const Candidate* near_rival(const Cell& cell, const Diagnosis& diagnosis);

/// By how many nats the first candidate is ahead of nothing, and of a rival that is near.
double nats_ahead(const Cell& cell, const Diagnosis& diagnosis);

/// Whether the first candidate explains hardly any of what is missing. As long as the true cause is
/// not in the model, its remains look like small effects, and evidence for these may deceive.
bool explains_little(const Diagnosis& diagnosis);

/// Whether the held-out error falls with a candidate alone: that of the points, or clearly that of
/// measured orientations while the points keep theirs.
bool helps(const Diagnosis& diagnosis, const Candidate& candidate);

/// Whether the orientations are clearly above their noise floor: something turns the tool.
bool turned(const Diagnosis& diagnosis);

}  // namespace plumb::offline
