// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "runs/run.hpp"
#include "show/block.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// A run as the history shows it.
struct ListedRun {
  Run run;
  enum class State { kCurrent, kOther } state = State::kOther;  // of the present cell and data
};

/// {runs: [{run, created, effects, held_out, fit, ...}]}
Json runs_json(const std::vector<ListedRun>& runs);
Blocks runs_blocks(const std::vector<ListedRun>& runs);

/// Parameters that changed and what it did to the held-out error.
Json diff_json(const Run& a, const Run& b);
std::string diff_text(const Run& a, const Run& b);

}  // namespace plumb::offline::show
