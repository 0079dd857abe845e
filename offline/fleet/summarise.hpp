// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "fleet/cell_summary.hpp"

namespace plumb::offline::fleet {

/// The files that a cell is fitted from, with their check sums: cell.toml and its measurements. A
/// file that cannot be read has an empty sum. Throws nothing.
std::vector<SummaryInput> inputs_of(const std::filesystem::path& cell_folder);

/// Fits the cell in that folder as it stands and writes nothing. What is wrong with it becomes its
/// `error`. Cost: a fit.
CellSummary summarise(const std::filesystem::path& cell_folder);

}  // namespace plumb::offline::fleet
