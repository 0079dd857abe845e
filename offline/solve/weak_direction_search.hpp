// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// Combinations of the arm's numbers among `parameters` that the poses of `data` show worse than a
/// third of [fit] prior_mm and prior_mrad: those are held near nominal. With x the numbers of the
/// arm in units of that prior, J_x their whitened derivatives less what frame, target and effects
/// explain, and
///
///   J_x = U diag(s) V^T
///
/// the columns of V with s < 3. What the poses show clearly is thus left exactly as they show it.
/// None without a cell, or where the cell sets the prior to 0. Numbers with a prior of their own in
/// [fit] prior take no part. Cost: one evaluation on at most 4000 rows, and a QR decomposition.
WeakDirections weak_directions(const FitData& data, const ArmState& state,
                               const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
