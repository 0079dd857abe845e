// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "fleet/cell_summary.hpp"
#include "fleet/results_folder.hpp"

namespace plumb::offline::fleet {

/// What a cell is fitted from, with check sums: the program, cell.toml, its measurements, and the
/// priors that it takes over from a fleet. A file that cannot be read has an empty sum. Throws
/// nothing.
std::vector<SummaryInput> inputs_of(const std::filesystem::path& cell_folder);

/// Fits the cell in that folder as it stands and writes nothing. What is wrong with it becomes its
/// `error`. Cost: a fit, and half of one for what the readings alone show; a diagnosis if asked
/// for.
CellSummary summarise(const std::filesystem::path& cell_folder, Asked asked);

}  // namespace plumb::offline::fleet
