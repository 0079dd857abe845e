// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "fit/calibration.hpp"
#include "show/block.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// Where the artefacts are that the readings are about (cell/artefacts.hpp), in the base frame:
/// "points" with their distances, and "artefacts" that are no points. Nothing without them.
void add_artefacts(const Cell& cell, const Calibration& calibration, Json& out);

/// The same for the terminal, and what the readings leave open.
Blocks artefacts_blocks(const Cell& cell, const Calibration& calibration);

}  // namespace plumb::offline::show
