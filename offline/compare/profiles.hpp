// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "compare/profile.hpp"

namespace plumb::offline::compare {

/// Samples of the used poses for the value that a row has.
using SamplesOf = std::function<std::vector<Sample>(const std::function<double(int row)>&)>;

/// By joint angle; by region as seen from the base (reach, height, azimuth); by load (payload,
/// torque of gravity on each turning joint, of 1 kg at the tool if no mass is known); by context
/// (side from which each joint came, temperatures, time); and by order. What never varies is left
/// out, except joints.
std::vector<ErrorProfile> profiles(const Cell& cell, const Measurements& measured,
                                   const ArmState& state, const SamplesOf& samples);

}  // namespace plumb::offline::compare
