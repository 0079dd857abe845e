// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "diagnose/formula_offer.hpp"

namespace plumb::offline {

/// "dq5 = k1*sin(q4)*cos(q6)"
std::string law_of(const FormulaOffer& offer);

/// "A law that fits: dq5 = k1*sin(q4)*cos(q6) (k1 = 320 µrad): held-out error 0.106 -> 0.019 mm."
/// The first one is the next step of the diagnosis; the others say the command that adds them.
std::string formula_sentence(const Cell& cell, const FormulaOffer& offer, std::size_t place);

}  // namespace plumb::offline
