// SPDX-License-Identifier: Apache-2.0
#include "diagnose/evidence_without.hpp"

#include <algorithm>

#include "diagnose/change_points.hpp"

namespace plumb::offline {

double evidence_without(const JudgedModel& without, const Found& found) {
  const Scorer scorer(without.whitened);
  const Regressor regressor = regressor_of(without.whitened, found);
  const RegressorScore own = found.moves.empty()
                                 ? scorer.score(regressor)
                                 : score_moves(scorer, regressor, found.moves.size());
  const Found* listed =
      without.look.find(*without.model.cell, key_of(*without.model.cell, found.entry));
  return listed == nullptr ? own.evidence.ln_bayes
                           : std::max(own.evidence.ln_bayes, listed->ln_bayes());
}

}  // namespace plumb::offline
