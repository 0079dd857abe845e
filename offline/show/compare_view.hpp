// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "fit/run_store.hpp"
#include "show/comparison.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// `result` of `plumb compare`; errors are measured - predicted in the measurement frame.
Json compare_json(const Comparison& comparison, const Run& run, double tolerance_m);

/// Verdict, error table, worst poses, and where the error is large.
std::string compare_text(const Comparison& comparison, const Run& run, double tolerance_m);

}  // namespace plumb::offline::show
