// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "program/toml_table.hpp"

namespace plumb::offline {

/// Warnings for numbers that look as if they were in another unit: W-CELL-ANGLE for 90 rad,
/// 1.5708 deg or joint limits of a few degrees, W-CELL-LENGTH for links longer than 20 m.
void warn_of_units(TomlTable& joint, const format::JointRow& row, const Cell& cell);

}  // namespace plumb::offline
