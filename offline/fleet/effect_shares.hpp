// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fleet/cell_summary.hpp"

namespace plumb::offline::fleet {

/// In how many arms of a model an effect acts that their cells do not list, and how much that
/// speaks for it in a further arm.
struct EffectShare {
  std::string effect;
  double arms = 0.0;       // the sum over the arms of the probability that it acts in them
  double odds_nats = 0.0;  // added to ln B of that effect in an arm of this model
};

/// Shares of the effects that a diagnosis looked at.
struct EffectShares {
  int diagnosed = 0;  // arms
  std::vector<EffectShare> effects;
};

/// A mixture of arms with a Dirichlet prior: before any arm is known, an arm has none of the
/// effects with weight kNothing, or one of them with weight kOne each. Expectation maximisation
/// [Dempster, Laird & Rubin 1977] over the Bayes factors of the arms gives the expected counts n,
/// and
///
///   odds of effect c = ln[(n_c + kOne) / (n_0 + kNothing)] - ln[kOne / kNothing]
///
/// so that without any arm all odds are 0. Empty if fewer than kFewestArms arms were diagnosed.
EffectShares learn_shares(const std::vector<const CellSummary*>& arms);

}  // namespace plumb::offline::fleet
