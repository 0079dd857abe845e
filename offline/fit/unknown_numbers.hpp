// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"
#include "solve/identifiable.hpp"

namespace plumb::offline {

struct EarlierArm;

/// Candidates of a fit beside what an earlier arm knows.
struct UnknownNumbers {
  std::vector<Parameter> candidates;   // the known numbers before other ones of the arm
  std::vector<std::string> redundant;  // no pose tells them from others: held at nominal
  std::vector<std::string> placing;    // where tracker and reflector are: poses must show it
};

/// What the earlier arm knows makes a number look independent that acts as another one does, the
/// offset of J1 as a turn of the tracker, say; so poses all over the joint limits are asked.
/// placed: with tracker and reflector about where they are. Cost: that of `at_imagined_poses`.
UnknownNumbers unknown_numbers(const EarlierArm& earlier, const Cell& cell, const FitData& data,
                               const ArmState& placed, const std::vector<Parameter>& candidates);

/// However well the arm is known, too few poses do not show where it stands: throws Failure
/// (kNumbersSayNo, E-FIT-FEW) if one of these numbers is among those held.
void check_placed_by_poses(const FitData& data, const UnknownNumbers& unknown,
                           const std::vector<std::string>& held);

}  // namespace plumb::offline
