// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "compare/comparison.hpp"

namespace plumb::offline::show {

/// What a comparison found, a sentence each, the same on the screen and for programs.
std::string lack_of_fit_words(const compare::LackOfFit& found);
std::string order_words(const compare::Autocorrelation& found);
std::string joint_words(const Cell& cell, const compare::Comparison& found);
std::string where_words(const compare::Comparison& found);
std::string changes_words(const compare::Changes& found);
std::string step_words(const Cell& cell, const Measurements& measured,
                       const compare::StepFound& step);
std::string drift_words(const Cell& cell, const Measurements& measured,
                        const compare::DriftFound& drift);

/// "the reflector or the tool", "the tracker or the base", "the zero of J3".
std::string mover_words(const Cell& cell, compare::Mover mover, int joint);

/// "tool", "base", "joint": as [effects.step] says it.
const char* mover_name(compare::Mover mover);

/// "angle of J4", "height", "torque of J2".
std::string quantity_words(const compare::ErrorProfile& profile);

/// A value of a profile in the unit shown, and that unit; "" if it has none.
double in_unit(double value, compare::ErrorProfile::Unit unit);
const char* unit_name(compare::ErrorProfile::Unit unit);

/// "1 in 20,000" of a natural logarithm of a probability; "below 1 in 10^12".
std::string chance(double ln_p);

}  // namespace plumb::offline::show
