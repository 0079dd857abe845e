// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "recheck/recheck.hpp"
#include "recheck/recheck_plan.hpp"
#include "show/block.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// The answer in one sentence. `run`: the run that was rechecked.
std::string recheck_sentence(const Cell& cell, const recheck::Recheck& found, const Run& run);

/// Its class: good if the calibration is still true, bad if the arm has changed, partly if these
/// poses cannot tell, or if the calibration never kept the tolerance.
const char* class_of(const Cell& cell, const recheck::Recheck& found);

/// `result` of `plumb recheck` but for `blocks` and `run`.
Json recheck_json(const Cell& cell, const recheck::Recheck& found, const Run& run);

/// The sentence, errors before and after, what has changed, and what the poses would not show.
Blocks recheck_blocks(const Cell& cell, const recheck::Recheck& found, const Run& run);

/// `result` of `plumb plan --recheck` but for `blocks`, these, and its CSV file.
Json recheck_plan_json(const Cell& cell, const recheck::RecheckPlan& plan, const Run& run,
                       const Measurements& own);
Blocks recheck_plan_blocks(const Cell& cell, const recheck::RecheckPlan& plan, const Run& run);
std::string recheck_plan_csv(const Cell& cell, const recheck::RecheckPlan& plan,
                             const Measurements& own);

}  // namespace plumb::offline::show
