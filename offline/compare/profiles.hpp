// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "compare/profile.hpp"

namespace plumb::offline::compare {

/// Makes the samples of all used poses from the value of a quantity at each row.
using SamplesOf = std::function<std::vector<Sample>(const std::function<double(int row)>&)>;

/// Profiles by joint angle; by region as seen from the base (reach, height, azimuth); by load
/// (payload, torque of gravity on each turning joint, of 1 kg at the flange if no mass is known);
/// by context (side from which each joint came, temperatures, time); by order; and by set-up.
/// Quantities that do not vary are left out, except joint angles.
std::vector<ErrorProfile> profiles(const Cell& cell, const Measurements& measured,
                                   const ArmState& state, const SamplesOf& samples);

}  // namespace plumb::offline::compare
