// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

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

/// The title of a law: "balancing spring".
std::string title_of(const std::string& effect);

}  // namespace plumb::offline
