// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "answers/answers.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/fit.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// `result` of `plumb fit` but for `run`.
Json fit_json(const Cell& cell, const Measurements& measured, const Fit& fit,
              const Answers& answers);

/// Verdict, error table, parameters with 1 sigma, frame, target, tree.
std::string fit_text(const Cell& cell, const Measurements& measured, const Fit& fit,
                     const Answers& answers);

/// Where base and reflector stood, of each set-up, as indented lines.
///
/// @param held  Names of the parameters that the readings leave open.
std::string measurement_text(const Cell& cell, const ArmState& state,
                             const std::vector<std::string>& held);

}  // namespace plumb::offline::show
