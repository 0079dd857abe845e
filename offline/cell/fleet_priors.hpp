// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cell/cell.hpp"

namespace plumb::offline {

/// A name of the nominal chain: equal for arms of one model, whatever they are called.
std::string model_key(const format::Chain& nominal);

/// What a fleet taught about arms of one model.
struct FleetPriors {
  std::vector<Prior> priors;     // of their numbers
  std::vector<SisterOdds> odds;  // of effects that cells do not list
};

/// What a fleet file (plumb fleet) knows of arms of this chain; nothing if it holds too few of them
/// to learn from. Throws Failure (kInput) if the file cannot be read (E-READ), is none of plumb
/// fleet, or holds no such arm (E-CELL-PRIOR).
FleetPriors fleet_priors(const std::filesystem::path& file, const format::Chain& nominal);

/// What of these settings a fleet taught, as a text: equal for equal numbers. Empty if it is
/// nothing.
std::string fleet_priors_text(const FitSettings& settings);

}  // namespace plumb::offline
