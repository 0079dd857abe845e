// SPDX-License-Identifier: Apache-2.0
#include "cli/cell_writing.hpp"

#include <fmt/format.h>

#include "cell/effects_edit.hpp"
#include "program/file.hpp"
#include "program/interrupt.hpp"

namespace plumb::offline::cli {

Cell with_effects(const Cell& cell, const std::vector<EffectEntry>& effects) {
  return parse_cell(edited_effects(cell, effects), cell.file);
}

void replace_cell(const Cell& edited, bool dry_run, Outcome& outcome) {
  outcome.result["files"] = Json::array({edited.file.string()});
  outcome.result["dry_run"] = dry_run;
  outcome.text += fmt::format("\n{} {}\n", dry_run ? "would edit" : "edited", edited.file.string());
  if (dry_run) return;
  const Writing writing;
  write_file_atomically(edited.file, edited.text);
}

}  // namespace plumb::offline::cli
