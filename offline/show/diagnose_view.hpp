// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.hpp"
#include "show/block.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// `result` of `plumb diagnose` but for `blocks`.
Json diagnose_json(const Cell& cell, const Diagnosis& diagnosis);

/// The class of a finding, as of the verdict of a fit.
const char* class_of(Finding finding);

/// The first candidates in few columns, or all of them with all that is known.
enum class Candidates { kFirst, kAll };

/// Verdict, errors before and after, ranked candidates, what cannot be told apart, and what these
/// data cannot show.
Blocks diagnosis_blocks(const Cell& cell, const Diagnosis& diagnosis, Candidates shown);

/// Whether these poses support a candidate: "yes", "no", "no gain", "unlikely", "one of 2".
std::string support_words(const Diagnosis& diagnosis, const Candidate& candidate);

/// ["J2", "J3"]
Json joints_json(const Cell& cell, const EffectEntry& effect);

}  // namespace plumb::offline::show
