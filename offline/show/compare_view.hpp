// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "answers/answers.hpp"
#include "compare/comparison.hpp"
#include "runs/run.hpp"
#include "show/block.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// `result` of `plumb compare` but for `blocks`; errors are measured - predicted in the measurement
/// frame.
Json compare_json(const Cell& cell, const Measurements& measured,
                  const compare::Comparison& comparison, const Run& run, const Answers& answers);

/// Verdict, errors, patterns, worst readings, and where it fails.
Blocks compare_blocks(const Cell& cell, const Measurements& measured,
                      const compare::Comparison& comparison, const Run& run,
                      const Answers& answers);

/// The errors, and how many readings keep the tolerance.
Blocks tolerance_blocks(const Cell& cell, const Measurements& measured,
                        const compare::Comparison& comparison, const Fit& fit);

/// What moved during the measurement, if that explains enough of the error.
Blocks moved_blocks(const Cell& cell, const Measurements& measured,
                    const compare::Comparison& comparison);

/// The error by set-up, lack of fit, what the joints explain, and what changed with time.
Blocks pattern_blocks(const Cell& cell, const Measurements& measured,
                      const compare::Comparison& comparison, const Fit& fit);

/// Where the error is large, and how it changes with what matters.
Blocks where_blocks(const Cell& cell, const compare::Comparison& comparison,
                    const Answers& answers);

/// The ten readings with the largest errors, in the order of `comparison.poses`.
Table worst_table(const compare::Comparison& comparison);

/// The command to type next, without `plumb`: that of the answers, unless something moved or they
/// name `compare` itself, which has just been seen.
std::string after_comparison(const Cell& cell, const compare::Comparison& comparison,
                             const Fit& fit, const Answers& answers);

}  // namespace plumb::offline::show
