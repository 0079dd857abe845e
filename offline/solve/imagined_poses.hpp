// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// Derivatives by `parameters` of the measured axes at 120 random poses all over the joint limits,
/// unweighted: what not even these tell apart is a matter of the arm, not of the poses. No
/// parameter may be of an effect: nobody knows what acts on the arm there.
Eigen::MatrixXd at_imagined_poses(const Cell& cell, const FitData& data, const ArmState& state,
                                  const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
