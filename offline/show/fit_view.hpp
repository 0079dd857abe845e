// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "answers/answers.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/fit.hpp"
#include "show/block.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// `result` of `plumb fit` but for `blocks` and `run`.
Json fit_json(const Cell& cell, const Measurements& measured, const Fit& fit,
              const Answers& answers);

/// Verdict, errors, the fitted arm.
Blocks fit_blocks(const Cell& cell, const Measurements& measured, const Fit& fit,
                  const Answers& answers);

/// Of the fitted arm alone: parameters with 1 sigma, what was taken over from an earlier arm, where
/// base and reflector stood, the tree.
Blocks arm_blocks(const Cell& cell, const Fit& fit);

}  // namespace plumb::offline::show
