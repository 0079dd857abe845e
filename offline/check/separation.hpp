// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "cell/cell.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// Numbers that the data cannot tell apart, or hardly.
struct Separation {
  enum class Cause {
    kChoice,  // of where frames begin and end: no harm, one of them is enough
    kArm,     // no pose of this arm separates them
    kPoses,   // these poses do not; others would
    kWeak     // they do, but so little that nominal is the better guess, or |rho| > 0.95
  } cause = Cause::kChoice;
  std::string parameter;              // held at nominal; or one of the pair
  std::vector<std::string> partners;  // that do the same to the measured point
  double rho = 1.0;                   // correlation; 1 if they cannot be separated at all
  std::string text;                   // one sentence
};

/// Explains why `held` cannot be found besides `kept`, and which pairs of `kept` hang together.
/// `state`: arm, frame and target at which the derivatives are taken; `covariance`: of `kept`.
std::vector<Separation> separations(const Cell& cell, const FitData& data, const ArmState& state,
                                    const std::vector<Parameter>& kept,
                                    const std::vector<Parameter>& held,
                                    const Eigen::MatrixXd& covariance);

}  // namespace plumb::offline
