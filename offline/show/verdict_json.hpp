// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/fit.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// verdict: the answer in one sentence; verdict_head: in few words; verdict_class: good, partly,
/// bad or unknown; verdict_error: the held-out error that it rests on.
void add_verdict(const Cell& cell, const Measurements& measured, const Fit& fit, Json& out);

}  // namespace plumb::offline::show
