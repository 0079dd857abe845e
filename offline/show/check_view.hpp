// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "check/check.hpp"
#include "program/verdict.hpp"
#include "show/block.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// `result` of `plumb check` but for `blocks`.
Json check_json(const Cell& cell, const Check& check);

/// The beginning of the verdict and its class: bad if the data are not usable as they are, partly
/// if only for positions or only with another effect.
Verdict check_verdict(const Check& check);

/// Verdict, readings, joints, what cannot be told apart, effects. Findings are shown apart.
Blocks check_blocks(const Cell& cell, const Check& check);

}  // namespace plumb::offline::show
