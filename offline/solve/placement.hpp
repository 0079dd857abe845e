// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/parameter.hpp"
#include "program/problem.hpp"
#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// Where tracker and reflector may stand: fits frame and target (those of `candidates` that belong
/// to the measurement) with the arm of `nominal`, from a closed-form start and, if that does not
/// look right, from 24 turns of the frame that leave no other farther than 63 degrees away. The
/// distinct minima that are not much worse than the best, which comes first. Several set-ups are
/// placed one after the other, and then together.
std::vector<Solution> placements(const FitData& data, const ArmState& nominal,
                                 const std::vector<Parameter>& candidates);

/// Largest angle between the tracker frames of two states [rad]; below kSameTurn_rad they are one.
double turn_between(const ArmState& a, const ArmState& b);
inline constexpr double kSameTurn_rad = 0.01;

/// The best of them, on all of `data`.
Solution place(const FitData& data, const ArmState& nominal,
               const std::vector<Parameter>& candidates);

/// W-FIT-AMBIGUOUS: frames `best` and `other` fit almost equally well.
Problem ambiguous_frame(const ArmState& best, const ArmState& other);

}  // namespace plumb::offline
