// SPDX-License-Identifier: Apache-2.0
#include "cli/cell_writing.hpp"

#include <fmt/format.h>

#include "cell/effects_edit.hpp"
#include "cli/cell_lock.hpp"
#include "program/file.hpp"
#include "program/interrupt.hpp"

namespace plumb::offline::cli {

Cell with_effects(const Cell& cell, const std::vector<EffectEntry>& effects) {
  Cell out = parse_cell(edited_effects(cell, effects), cell.file);
  out.measurement = cell.measurement;  // with the points that its rows touch
  return out;
}

Cell open_cell_to_change(const Globals& globals, Outcome& outcome) {
  Outcome before_the_lock;
  lock_cell(open_cell(globals, before_the_lock).directory);
  return open_cell(globals, outcome);
}

void check_unchanged(const Cell& read) {
  if (read_file(read.file) == read.text) return;
  throw Failure(Exit::kInput,
                {.code = "E-CELL-CHANGED",
                 .message = fmt::format("{} was edited while plumb was working with it; it is left "
                                        "as it is now",
                                        display_name(read.file)),
                 .help = "give the same command again"});
}

void replace_cell(const Cell& read, const Cell& edited, bool dry_run, Outcome& outcome) {
  outcome.result["files"] = Json::array({edited.file.string()});
  outcome.result["dry_run"] = dry_run;
  outcome.text += fmt::format("\n{} {}\n", dry_run ? "would edit" : "edited", edited.file.string());
  if (dry_run) return;
  const Writing writing;
  check_unchanged(read);
  write_file_atomically(edited.file, edited.text);
}

}  // namespace plumb::offline::cli
