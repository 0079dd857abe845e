// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "diagnose/formula_offer.hpp"
#include "diagnose/held_out_predictions.hpp"
#include "diagnose/regressor.hpp"
#include "fit/calibration.hpp"
#include "fit/split.hpp"

namespace plumb::offline {

/// A fitted model that leaves structure which no law of the library explains.
struct FormulaQuestion {
  const Cell& cell;
  const Measurements& measured;
  const Split& split;
  const std::vector<int>& choosing;  // rows by which terms are chosen
  const std::vector<int>& fit;       // rows
  const std::vector<EffectEntry>& effects;
  const Calibration& calibration;    // with these effects
  const HeldOutPredictions& before;  // of this model
  const BadRows& bad;
  const Pattern& pattern;
  /// Predictions of a model with other effects, in folds or of the held-out poses.
  std::function<HeldOutPredictions(const std::vector<EffectEntry>&, const Calibration&)> held_out;
};

/// Formulas for it, best first, at most three. The terms are chosen at the whitened fit; each
/// formula is then an effect of the cell as any other and fitted as such, and stays only if the
/// error of unseen poses falls clearly, and in every fold. Empty: none does, or formulas cannot
/// read what it depends on. Cost: a fit for every fold and one more, of each of three formulas.
std::vector<FormulaOffer> formula_offers(const FormulaQuestion& question);

}  // namespace plumb::offline
