// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fit/calibration.hpp"
#include "plumb/runtime/detail/effect.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// Whether the numbers of a calibration can be believed. A check throws Failure (kNumbersSayNo).

/// E-FIT-FAR: a parameter of the arm more than 100 mm or 10 deg from nominal: the fit has turned
/// it into another arm.
void check_same_arm(const std::vector<Estimate>& estimates);

/// W-FIT-FAR: a parameter of the arm more than 20 mm or 2 deg from nominal; then the nominal value
/// is probably wrong.
void warn_of_far_parameters(const std::vector<Estimate>& estimates, std::vector<Problem>& remarks);

/// Whether a parameter may be within the bounds of its law, three sigma allowed.
bool possible(double value, double std, const EffectParameter& info);

/// W-FIT-IMPOSSIBLE: a parameter of an effect outside the bounds of its law, for example a spring
/// that pushes the wrong way.
void warn_of_impossible_effects(const Calibration& calibration, std::vector<Problem>& remarks);

}  // namespace plumb::offline
