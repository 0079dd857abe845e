// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "diagnose/diagnosis.hpp"

namespace plumb::offline {

/// The one name of an effect on every screen, with the words that `plumb add` and `plumb drop`
/// take in brackets: "gear ripple, 20 cycles a turn (gear_ripple:J2)".
std::string in_words(const Cell& cell, const EffectEntry& entry);

/// The same of a ripple with all its waves: "gear ripple, 20 and 8.5 cycles a turn
/// (gear_ripple:J2)".
std::string in_words(const Cell& cell, const EffectEntry& entry, const std::vector<double>& cycles);

/// The same of a part that moved several times: "step of the base after rows 41 and 97 (step)".
std::string in_words(const Cell& cell, const Candidate& candidate);
std::string in_words(const Cell& cell, const Addition& added);

/// The same of an effect that is known by its key: "balancing spring (gravity_compensator:J2)".
std::string key_in_words(std::string key);

/// "gravity_free:J2+J3": the effect as the command line names it.
std::string command_name(const Cell& cell, const EffectEntry& entry);

/// The same with its numbers, as `plumb plan --separate` takes two of.
std::string planning_argument(const Cell& cell, const EffectEntry& effect);

/// "20 and 8.5 cycles a turn"; "12 waves, the largest at 16.9 cycles a turn".
///
/// @param cycles  The largest wave first.
std::string waves_words(const std::vector<double>& cycles);

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

/// A direction of gravity as cell.toml writes it: "[0, 0, -9.81]".
std::string gravity_text(const std::array<double, 3>& gravity);

/// The finding at the start, and with `apply` at the end, each in one sentence.
std::string verdict_text(const Cell& cell, const Diagnosis& diagnosis);
std::string verdict_after_text(const Cell& cell, const Diagnosis& diagnosis);

}  // namespace plumb::offline
