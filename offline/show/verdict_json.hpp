// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "answers/answers.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// finding: what people ask first, as answers/answers.hpp. And of the first answer alone, verdict:
/// in one sentence; verdict_head: in few words; verdict_class: good, partly, bad or unknown;
/// verdict_error: the held-out error that it rests on.
void add_verdict(const Cell& cell, const Fit& fit, const Answers& answers, Json& out);

}  // namespace plumb::offline::show
