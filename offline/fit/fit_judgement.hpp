// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fit/calibrate.hpp"
#include "fit/solver.hpp"
#include "plumb/runtime/detail/effect.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// Whether a calibration can be believed. Each check throws Failure (kNumbersSayNo).

/// E-FIT-FEW: no more coordinates than kept parameters. If there are enough coordinates for the
/// candidates of arm, frame and target alone, the message blames the effects.
void check_enough(const FitData& data, std::size_t kept, const std::vector<Parameter>& candidates);

/// E-FIT-FORMULA: a formula has no value, or no slope, at a row of the data.
[[noreturn]] void refuse_undefined(const FitData& data, const format::Effect& effect, int row);

/// E-FIT-CONVERGE: the solver gave up.
void check_converged(const Solution& solution);

/// E-FIT-MISS: the points are still missed by more than 1 % of the reach, which no error of an
/// arm explains.
void check_meets(const Cell& cell, const FitData& data, const Solution& solution);

/// W-FIT-AMBIGUOUS: frames `best` and `other` fit almost equally well.
Problem ambiguous_frame(const ArmState& best, const ArmState& other);

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
