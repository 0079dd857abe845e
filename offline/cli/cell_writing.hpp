// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/cell_data.hpp"
#include "program/output_files.hpp"

namespace plumb::offline::cli {

/// The cell with other effects, as its edited file will read. Throws as `edited_effects`.
Cell with_effects(const Cell& cell, const std::vector<EffectEntry>& effects);

/// The cell as `open_cell`, locked against every other plumb before it is read and until this
/// process ends.
Cell open_cell_to_change(const Globals& globals, Outcome& outcome);

/// Refuses (E-CELL-CHANGED) if the cell file no longer holds what was read: somebody edited it
/// meanwhile, and what they wrote would be lost.
void check_unchanged(const Cell& read);

/// Puts the new text in place of the cell file that was read, all or nothing; with --dry-run only
/// says so.
void replace_cell(const Cell& read, const Cell& edited, bool dry_run, Outcome& outcome);

}  // namespace plumb::offline::cli
