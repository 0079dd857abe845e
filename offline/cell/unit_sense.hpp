// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cell/cell.hpp"
#include "program/toml_table.hpp"

namespace plumb::offline {

/// Warnings for numbers that look as if they were in another unit: W-CELL-ANGLE for 90 rad,
/// 1.5708 deg or joint limits of a few degrees, W-CELL-LENGTH for links longer than 20 m.
void warn_of_units(TomlTable& joint, const format::JointRow& row, const Cell& cell);

/// W-CELL-GRAVITY: a gravity other than that of the Earth's surface, with the likely unit. Silent
/// for zero, which switches gravity off.
void warn_of_gravity(TomlTable& robot, const Cell& cell);

/// W-CELL-MASS: a link or payload of more than 5 tonnes, most often grams.
void warn_of_mass(TomlTable& table, std::optional<double> mass_kg);

}  // namespace plumb::offline
