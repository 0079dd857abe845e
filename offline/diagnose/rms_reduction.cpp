// SPDX-License-Identifier: Apache-2.0
#include "diagnose/rms_reduction.hpp"

#include "noise/orientation_floor.hpp"
#include "noise/weights.hpp"
#include "solve/evaluation.hpp"

namespace plumb::offline {

double rms_reduction(const Cell& cell, const Measurements& measured, const std::vector<int>& fit,
                     const Calibration& from, const Calibration& to) {
  FitData data;
  data.measured = &measured;
  data.rows = without_outliers(without_outliers(fit, from.outliers), to.outliers);
  data.sigma_m = stated_sigma(cell, measured);
  data.sigma_rad = orientation_floor(cell, measured).sigma_rad;
  const double before = evaluate(data, from.state, {}).residual.norm();
  const double after = evaluate(data, to.state, {}).residual.norm();
  return before > 0.0 ? 1.0 - after / before : 0.0;
}

}  // namespace plumb::offline
