// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// Directions in the space of the arm's numbers among `parameters` that the poses of `data` tell
/// worse than a third of [fit] prior_mm and prior_mrad. Those are held near nominal. Let x be the
/// numbers of the arm in units of that prior, J_x their whitened derivatives without the part that
/// frame, target and effects explain, and
///
///   J_x = U diag(s) V^T
///
/// The directions are the columns of V with s < 3. All other directions have no prior, so that the
/// poses alone decide them. There are none without a cell, or if the cell sets the prior to 0.
/// Numbers with a prior of their own in [fit] prior are not included. Cost: one evaluation on at
/// most 4000 rows, and a QR decomposition.
WeakDirections weak_directions(const FitData& data, const ArmState& state,
                               const std::vector<Parameter>& parameters);

/// Every number of the arm among `parameters` as a direction of its own, for a fit that is lost
/// otherwise: far from where the weak directions were found others are weak, along which its
/// numbers wander. The prior of the cell holds each, which is wide beside what the poses tell of
/// all that they do show. `share` is that of the weak directions, since only what lies in these is
/// in fact held.
WeakDirections all_directions(const FitData& data, const ArmState& state,
                              const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
