// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/link_calibration.hpp"

namespace plumb::offline::study {

/// The reference model of the study with correct statics, its one unknown left free: links as
/// calibrated and 1 / EI of both bars. Loads turn by the linear rotation of the beam formulas.
struct BeamFormula {
  Links d = kNominalLinks;
  double flexibility = 0.0;  // 1 / EI [1 / (N m^2)]
};

/// Five numbers by linear least squares.
BeamFormula fit_beams(const PlanarPoses& measured);

/// Shape (n, 2) [m].
Samples points(const BeamFormula& model, const RowsN& q);

}  // namespace plumb::offline::study
