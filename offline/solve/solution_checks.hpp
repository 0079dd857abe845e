// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/parameter.hpp"
#include "plumb/format/model.hpp"
#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// Whether a fit can be solved and its solution can be believed. Each check throws Failure
/// (kNumbersSayNo).

/// E-FIT-FEW: no more coordinates than kept parameters. If there are enough coordinates for the
/// candidates of arm, frame and target alone, the message blames the effects.
void check_enough(const FitData& data, std::size_t kept, const std::vector<Parameter>& candidates);

/// E-FIT-FORMULA: a formula has no value, or no slope, at a row of the data.
[[noreturn]] void refuse_undefined(const FitData& data, const format::Effect& effect, int row);

/// E-FIT-CONVERGE: the solver did not converge.
void check_converged(const Solution& solution);

/// E-FIT-MISS: the RMS residual still exceeds 1 % of the reach, which no error of an arm explains.
void check_meets(const Cell& cell, const FitData& data, const Solution& solution);

}  // namespace plumb::offline
