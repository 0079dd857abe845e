// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/units.hpp"

namespace plumb::offline {

/// A TOML basic string, quotes included.
std::string toml_string(const std::string& text);

/// [1, 2, 3] in `unit`; ["a", "b"].
std::string toml_list(const std::array<double, 3>& si, const Unit& unit);
std::string toml_list(const std::vector<std::string>& texts);

std::string toml_value(const EffectEntry::Value& value);

/// [{ joint = "J3", of = "J2", share = 1 }]
std::string toml_coupling(const format::Chain& arm);

/// { xyz = […], rpy = […] }; the rotation is written with the fewest digits that read back to the
/// same quaternion, or with all of them.
std::string toml_pose(const format::Pose& pose, const Unit& length, const Unit& angle);

}  // namespace plumb::offline
