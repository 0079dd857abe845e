// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/cell_data.hpp"
#include "program/output_files.hpp"

namespace plumb::offline::cli {

/// The cell with other effects, as its edited file will read. Throws as `edited_effects`.
Cell with_effects(const Cell& cell, const std::vector<EffectEntry>& effects);

/// Puts the new text in place of the cell file, all or nothing; with --dry-run only says so.
void replace_cell(const Cell& edited, bool dry_run, Outcome& outcome);

}  // namespace plumb::offline::cli
