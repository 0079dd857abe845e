// SPDX-License-Identifier: Apache-2.0
#include "cli/repair.hpp"

#include <fmt/format.h>

#include "cli/cell_writing.hpp"
#include "program/file.hpp"
#include "program/interrupt.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

fs::path fixed_name(const fs::path& file) {
  return file.parent_path() / (file.stem().string() + "_fixed" + file.extension().string());
}

std::string relative(const Cell& cell, const fs::path& file) {
  return file.lexically_proximate(cell.directory).generic_string();
}

/// New measurement files; the cell is told to read them.
void add_measurements(const Cell& cell, const MeasurementFiles& measured,
                      const MeasurementEdit& edit, CellEdit& in_cell, OutputFiles& files,
                      std::string& said, const WriteOptions& options) {
  const auto& read = cell.measurement.files;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < measured.tables.size(); ++i) {
    const bool held = i >= read.size();
    const fs::path& old = held ? cell.measurement.held_out.file : read[i];
    const fs::path file = fixed_name(old);
    files.add(file, edited(read_file(old), measured.tables[i].header_line, edit));
    said += "  " + wrote(file, options) + "\n";
    if (held)
      in_cell.held_out = "file:" + relative(cell, file);
    else
      names.push_back(relative(cell, file));
  }
  in_cell.files = names;
}

}  // namespace

std::string repair(const Cell& cell, const MeasurementFiles& measured, const Check& check,
                   const WriteOptions& options, Outcome& outcome) {
  if (cell.measurement.setups.size() > 1)
    throw Failure(Exit::kInput,
                  {.code = "E-CHECK-FIX-SETUPS",
                   .message = "check --fix does not rewrite the files of several set-ups",
                   .place = Place{.file = cell.file.string()},
                   .help = "see what is wrong, and put it right by hand: plumb check"});
  const Convention& labels = check.detection.present.convention;
  const Convention& meant = check.detection.best.convention;
  CellEdit in_cell = cell_edit(cell, labels, meant);
  MeasurementEdit in_files = measurement_edit(cell, labels, meant);
  in_files.add(check.orientations.edit);
  OutputFiles files;
  std::string said;
  if (!in_files.empty()) add_measurements(cell, measured, in_files, in_cell, files, said, options);
  const std::string text = edited(cell.text, cell.file.string(), in_cell);
  (void)parse_cell(text, cell.file);  // never leave a cell that cannot be read
  if (!options.dry_run) check_unchanged(cell);
  files.commit(options, outcome);
  outcome.result["files"].push_back(cell.file.string());
  if (!options.dry_run) {
    const Writing writing;
    write_file_atomically(cell.file, text);
  }
  return said +
         fmt::format("  {} {}\n", options.dry_run ? "would edit" : "edited", cell.file.string());
}

}  // namespace plumb::offline::cli
