// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"
#include "solve/identifiable.hpp"

namespace plumb::offline {

/// Parameters that the poses can tell apart, in order of preference, and the names of the rest.
struct ParameterSubset {
  std::vector<Parameter> kept;
  std::vector<std::string> held;
};

/// Rank analysis of the whitened derivatives at `state`, scaled so that 1 is the largest plausible
/// error of a robot parameter (5 mm, 5 mrad). With max_std = 1, a parameter whose standard
/// deviation exceeds that is held at nominal, because nominal is then the better estimate.
///
/// Readings that tell the shape of the arm and not its size leave one length open. With
/// Size::kGiven none is held for that: they are fitted together, and the prior of the cell decides
/// the size (weak_direction_search.hpp).
enum class Size { kMeasured, kGiven };
ParameterSubset identifiable_parameters(const FitData& data, const ArmState& state,
                                        const std::vector<Parameter>& candidates,
                                        const Identifiability& limits, Size size = Size::kMeasured);

}  // namespace plumb::offline
