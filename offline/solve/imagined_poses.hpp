// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// Unweighted derivatives of the measured axes by `parameters` at 120 random poses of each set-up
/// all over the joint limits. Parameters that even these poses cannot tell apart are redundant in
/// the model of the arm; more poses would not help. No parameter may belong to an effect, because
/// loads and temperatures are not known there.
Eigen::MatrixXd at_imagined_poses(const Cell& cell, const FitData& data, const ArmState& state,
                                  const std::vector<Parameter>& parameters);

}  // namespace plumb::offline
