// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "compare/comparison.hpp"
#include "fit/fit.hpp"

namespace plumb::offline::show {

/// The findings of a comparison as sentences, the same on the screen and for programs.

/// Whether the error of the fitted readings is more than noise, said so that it never contradicts
/// what is left on the held-out poses of the same fit.
std::string lack_of_fit_words(const compare::LackOfFit& found, const Fit& fit);

std::string order_words(const compare::Autocorrelation& found);
std::string joint_words(const Cell& cell, const compare::Comparison& found);
/// About which joint's axis orientations are off, and whether its angle explains it; empty if about
/// none.
std::string turning_joint_words(const Cell& cell, const compare::Turns& found);
/// What an error, "the error" or "the orientation error", changes with most; empty if nothing
/// changes it beyond chance.
std::string dependence_words(const std::vector<compare::ErrorProfile>& profiles, const char* error);
std::string changes_words(const Changes& found);
std::string step_words(const Cell& cell, const Measurements& measured, const StepFound& step);
std::string drift_words(const Cell& cell, const Measurements& measured, const DriftFound& drift);

/// "joint J4", "height in the base frame", "J2 torque".
std::string quantity_words(const compare::ErrorProfile& profile);

/// A value of a profile in the unit shown, and that unit; "" if it has none.
double in_unit(double value, compare::ErrorProfile::Unit unit);
const char* unit_name(compare::ErrorProfile::Unit unit);

/// A probability, given by its natural logarithm, as "1 in 20000" or "below 1 in 10^12".
std::string chance(double ln_p);

}  // namespace plumb::offline::show
