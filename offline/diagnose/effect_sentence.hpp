// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "diagnose/diagnosis.hpp"

namespace plumb::offline {

/// What an arm with this effect does, without a full stop: "J2 and J3 yield under gravity (masses
/// not given)".
std::string effect_sentence(const Cell& cell, const EffectEntry& entry,
                            const std::vector<double>& cycles);

/// The same of a candidate with its fitted numbers, whose sign may say something else: "J3 is
/// over-compensated on reversal".
std::string effect_sentence(const Cell& cell, const Candidate& candidate);

/// Of an effect that was added. A part that moved several times: "the tracker or the base moved
/// twice: after row 41 by 0.31 mm, after row 97 by 0.22 mm".
std::string effect_sentence(const Cell& cell, const Addition& added);

}  // namespace plumb::offline
