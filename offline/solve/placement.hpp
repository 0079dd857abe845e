// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/parameter.hpp"
#include "program/problem.hpp"
#include "solve/fit_data.hpp"
#include "solve/solution.hpp"

namespace plumb::offline {

/// Where tracker and reflector may stand. Fits frame and target (the parameters among `candidates`
/// that belong to the measurement) with the arm of `nominal`, from a closed-form start and, if its
/// residuals look too large, from the 24 rotations of a cube.
/// Returns the distinct minima that are not much worse than the best, the best one first. Several
/// set-ups are placed one after the other, and then together.
std::vector<Solution> placements(const FitData& data, const ArmState& nominal,
                                 const std::vector<Parameter>& candidates);

/// Largest angle between the tracker frames of two states [rad]. Below kSameTurn_rad, chosen far
/// above the error of a placement and far below the angle between two minima, they are the same
/// minimum.
double turn_between(const ArmState& a, const ArmState& b);
inline constexpr double kSameTurn_rad = 0.01;

/// The best of these placements.
Solution place(const FitData& data, const ArmState& nominal,
               const std::vector<Parameter>& candidates);

/// W-FIT-AMBIGUOUS: frames `best` and `other` fit almost equally well.
Problem ambiguous_frame(const ArmState& best, const ArmState& other);

}  // namespace plumb::offline
