// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/link_calibration.hpp"

namespace plumb::offline::study {

/// The reference model of the study with correct statics. The calibrated links and the one unknown
/// number, 1 / EI of both bars, are fitted. The loads turn by the linear rotation of the beam
/// formulas.
struct BeamFormula {
  Links d = kNominalLinks;
  double flexibility = 0.0;  // 1 / EI [1 / (N m^2)]
};

/// Fits the five numbers by linear least squares.
BeamFormula fit_beams(const PlanarPoses& measured);

/// The points that the model predicts, shape (n, 2) [m].
Samples points(const BeamFormula& model, const RowsN& q);

}  // namespace plumb::offline::study
