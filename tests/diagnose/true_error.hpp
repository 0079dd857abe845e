// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "arm/predicted_points.hpp"
#include "fit/calibrate.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/diagnose/begun.hpp"

namespace plumb::offline {

/// Per-axis RMS from the truth on fresh poses [m] of the arm fitted with these effects.
inline double true_error_of(const BlindCase& blind, const std::vector<EffectEntry>& effects) {
  Cell cell = blind.cell;
  cell.effects = effects;
  const ArmState state = calibrate(cell, blind.measured.measured, all_rows(blind)).state;
  const Simulation& fresh = blind.fresh_robot;
  const Rows3 error = fresh.true_p_M - predict_points(state, fresh.measured);
  return std::sqrt(error.squaredNorm() / static_cast<double>(error.size()));
}

}  // namespace plumb::offline
