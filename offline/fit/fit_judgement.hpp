// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "fit/calibration.hpp"
#include "plumb/runtime/detail/effect.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

// Whether the numbers of a calibration are plausible.

/// Throws Failure (kNumbersSayNo, E-FIT-FAR) if a parameter of the arm is more than 100 mm or 10
/// deg from nominal: the cell then describes another arm.
void check_same_arm(const std::vector<Estimate>& estimates);

/// Whether a parameter of the arm is more than 20 mm or 2 deg from nominal.
bool ends_far(const std::vector<Estimate>& estimates);

/// W-FIT-FAR: a parameter of the arm is more than 20 mm or 2 deg from nominal, so that the nominal
/// value is probably wrong. W-FIT-SCALE: all lengths together are longer or shorter than arms are
/// built; then lengths that this explains are not said to be far.
void warn_of_far_parameters(const Cell& cell, const Calibration& calibration,
                            std::vector<Problem>& remarks);

/// Whether a parameter is within the bounds of its law or less than three sigma outside.
bool possible(double value, double std, const EffectParameter& info);

/// W-FIT-IMPOSSIBLE: a parameter of an effect is outside the bounds of its law, like the stiffness
/// of a spring that pushes the wrong way.
void warn_of_impossible_effects(const Calibration& calibration, std::vector<Problem>& remarks);

}  // namespace plumb::offline
