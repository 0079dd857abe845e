// SPDX-License-Identifier: Apache-2.0
#include "diagnose/evidence_without.hpp"

#include <algorithm>

#include "diagnose/change_points.hpp"

namespace plumb::offline {

double evidence_as_it_is(const JudgedModel& without, const Found& found) {
  const Scorer scorer(without.whitened);
  const Regressor regressor = regressor_of(without.whitened, found);
  const RegressorScore own = found.moves.empty()
                                 ? scorer.score(regressor)
                                 : score_moves(scorer, regressor, found.moves.size());
  return own.evidence.ln_bayes;
}

double evidence_without(const JudgedModel& without, const Found& found) {
  const double own = evidence_as_it_is(without, found);
  const Found* listed =
      without.look.find(*without.model.cell, key_of(*without.model.cell, found.entry));
  return listed == nullptr ? own : std::max(own, listed->ln_bayes());
}

}  // namespace plumb::offline
