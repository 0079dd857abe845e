// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "program/problem.hpp"
#include "solve/fit_data.hpp"
#include "solve/identifiable.hpp"

namespace plumb::offline {

struct EarlierArm;

/// The candidates of a fit that also has the numbers of an earlier arm.
struct UnknownNumbers {
  std::vector<Parameter> candidates;   // the arm's numbers that the earlier one knows come first
  std::vector<std::string> redundant;  // no pose can tell these from others: held at nominal
  std::vector<std::string> placing;    // of tracker and reflector; the poses must determine them
};

/// With a prior from the earlier arm, a number that is redundant in the model looks independent:
/// the offset of J1, say, acts as a turn of the tracker. So redundancy is decided without readings,
/// at imagined poses all over the joint limits. placed: a state in which tracker and reflector are
/// about where they stand. Cost: that of `at_imagined_poses`.
UnknownNumbers unknown_numbers(const EarlierArm& earlier, const Cell& cell, const FitData& data,
                               const ArmState& placed, const std::vector<Parameter>& candidates);

/// The numbers of the reflector among those held: however many poses there are, these do not tell
/// them, as a tool that is vertical in all of them does not tell the height of the reflector from
/// that of the tracker. Any value then explains the readings alike. Empty with few different poses,
/// whose number is the reason.
std::vector<Parameter> reflector_left_open(const FitData& data, const UnknownNumbers& unknown,
                                           const std::vector<std::string>& held);

/// `state` with these numbers of the reflector as the earlier run has them.
ArmState with_reflector_of(const EarlierArm& earlier, const ArmState& state,
                           const std::vector<Parameter>& open);

/// N-FIT-REFLECTOR: says so.
Problem reflector_as_earlier(const EarlierArm& earlier, const std::vector<Parameter>& open);

/// Throws Failure (kNumbersSayNo, E-FIT-FEW) if a number of `unknown.placing` is among those held:
/// however well the arm is known, too few poses do not tell where tracker and reflector stand.
void check_placed_by_poses(const FitData& data, const UnknownNumbers& unknown,
                           const std::vector<std::string>& held);

}  // namespace plumb::offline
