// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/formula_terms.hpp"
#include "diagnose/regressor_score.hpp"

namespace plumb::offline {

/// Some terms of a list, chosen at a whitened fit.
struct FormulaChoice {
  std::vector<std::size_t> terms;  // their places, ascending
  double nats = 0.0;               // held-out evidence, the terms paid for
};

/// Sums of few terms that lower the residual, best first; none where nothing pays, or where the
/// terms that the other folds would choose for themselves do not lower the error of a fold. A term
/// is taken if it has an evidence of
///
///   n/2 ln(Q_before / Q_after) > ln T + 1/2 ln n
///
/// with n lines, sums of squares Q and T terms to choose among [Schwarz 1978]; one that has lost it
/// to later terms is dropped. The evidence of the whole is the same of predicted folds, less the
/// right side for each term. The first sum is out of all terms; others are its first few terms, and
/// sums of waves alone and of powers alone.
///
/// @param columns  One regressor whose columns are the terms, in their order.
///
/// Cost: a pass over the poses, and (folds + 3) T terms^2.
std::vector<FormulaChoice> choose_formulas(const Scorer& scorer, const Regressor& columns,
                                           const std::vector<FormulaTerm>& terms);

}  // namespace plumb::offline
