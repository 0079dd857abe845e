// SPDX-License-Identifier: Apache-2.0
#include "diagnose/finding.hpp"

namespace plumb::offline {

Finding decide(const Facts& facts) {
  if (!facts.judgeable || facts.wrong_gravity) return Finding::kUndecidable;
  if (facts.structure) return Finding::kUnknown;
  if (facts.law_not_shown || facts.slow_motion || facts.tied || facts.other_fate)
    return Finding::kUndecidable;
  if (facts.law)
    return facts.other_gravity || facts.refused ? Finding::kUndecidable : Finding::kMissing;
  return facts.noise_known && !facts.excess ? Finding::kComplete : Finding::kUndecidable;
}

}  // namespace plumb::offline
