// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "diagnose/diagnosis.hpp"

namespace plumb::offline {

/// "gear ripple of J2, 20 cycles a turn".
std::string in_words(const Cell& cell, const EffectEntry& entry);

/// The same of a ripple with all its waves: "..., 20 and 8.5 cycles a turn".
std::string in_words(const Cell& cell, const EffectEntry& entry, const std::vector<double>& cycles);

/// The finding at the start, and with `apply` at the end, each in one sentence.
std::string verdict_text(const Cell& cell, const Diagnosis& diagnosis);
std::string verdict_after_text(const Cell& cell, const Diagnosis& diagnosis);

}  // namespace plumb::offline
