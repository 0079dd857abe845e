// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/blind/hidden_case.hpp"

namespace plumb::tests {

/// Draws case `number` of the study of formulas: every other arm has a law outside the library, of
/// 2 or 5 sigma of the tracker's noise, in turn by kind; of the rest two in three hide nothing, and
/// one an effect of the library.
HiddenCase draw_formula_case(std::uint64_t study_seed, int number);

}  // namespace plumb::tests
