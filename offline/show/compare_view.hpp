// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "answers/answers.hpp"
#include "compare/comparison.hpp"
#include "runs/run.hpp"
#include "show/json.hpp"
#include "show/table.hpp"

namespace plumb::offline::show {

/// `result` of `plumb compare`; errors are measured - predicted in the measurement frame.
Json compare_json(const Cell& cell, const Measurements& measured,
                  const compare::Comparison& comparison, const Run& run, const Answers& answers);

/// Verdict, error table, worst poses, and where the error is large.
std::string compare_text(const Cell& cell, const Measurements& measured,
                         const compare::Comparison& comparison, const Run& run,
                         const Answers& answers);

/// The ten readings with the largest errors, in the order of `comparison.poses`.
Table worst_table(const compare::Comparison& comparison);

/// The command to type next, without `plumb`: that of the answers, unless something moved or they
/// name `compare` itself, which has just been seen.
std::string after_comparison(const Cell& cell, const compare::Comparison& comparison,
                             const Fit& fit, const Answers& answers);

}  // namespace plumb::offline::show
