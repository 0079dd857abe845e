// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fleet/cell_summary.hpp"

namespace plumb::offline::fleet {

/// In how many arms of a model an effect acts, and how much that speaks for it in a further arm.
struct EffectShare {
  std::string effect;
  double arms = 0.0;       // the sum over the arms of the probability that it acts in them
  double of = 0.0;         // so many arms tell
  double odds_nats = 0.0;  // added to ln B of that effect in an arm of this model
};

/// An effect acts in an arm whose model holds it; in one that was diagnosed, with the probability
/// that its Bayes factor gives it, by the shares of all arms (expectation maximisation [Dempster,
/// Laird & Rubin 1977]). It is absent from an arm whose model holds other effects instead; an arm
/// of which only the geometry was fitted tells nothing unless it was diagnosed. With n arms that
/// have it and m that have it not,
///
///   odds = ln[(n + kHave) / (m + kHaveNot)] - ln[kHave / kHaveNot]
///
/// so that without any arm they are 0. Only effects of the arm itself, by name; empty if fewer than
/// kFewestArms arms tell.
std::vector<EffectShare> learn_shares(const std::vector<const CellSummary*>& arms);

}  // namespace plumb::offline::fleet
