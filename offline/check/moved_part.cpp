// SPDX-License-Identifier: Apache-2.0
#include "check/moved_part.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "cell/table_place.hpp"
#include "check/row_lines.hpp"
#include "noise/main_jump.hpp"
#include "noise/moving_part.hpp"

namespace plumb::offline {
namespace {

/// The line and file of a row.
struct Spot {
  int line = 0;
  std::string file;
};

/// Rows that were not read from a file are numbered from 1.
Spot spot_of(const MeasurementFiles& measured, int row) {
  if (measured.tables.empty()) return {row + 1, ""};
  const RowPlace at = row_place(measured, row);
  const Table& table = measured.tables[static_cast<std::size_t>(at.table)];
  return {table.lines[static_cast<std::size_t>(at.row)],
          std::filesystem::path(table.file).filename().string()};
}

std::string between(const MeasurementFiles& measured, int before, int after) {
  const Spot a = spot_of(measured, before), b = spot_of(measured, after);
  if (a.file != b.file)
    return fmt::format("between line {} of {} and line {} of {}", a.line, a.file, b.line, b.file);
  if (a.file.empty()) return fmt::format("between rows {} and {}", a.line, b.line);
  return fmt::format("between lines {} and {} of {}", a.line, b.line, a.file);
}

/// Words for the possible range of the moment; empty if a single row is certain.
std::string uncertainty(const MeasurementFiles& measured, const StepFound& step) {
  if (step.earliest == step.latest) return "";
  const Spot a = spot_of(measured, step.earliest), b = spot_of(measured, step.latest);
  return fmt::format(
      "; the last reading before it stands in line {}{} to {}", a.line,
      a.file == b.file ? "" : " of " + a.file,
      a.file == b.file ? fmt::format("{}", b.line) : fmt::format("line {} of {}", b.line, b.file));
}

std::string adding_step(const Cell& cell, const StepFound& step) {
  const std::string joints =
      step.joint < 0
          ? ""
          : " --joints " + cell.nominal.joints[static_cast<std::size_t>(step.joint)].name;
  return fmt::format("plumb add step{} --set after_row={} --set of={}", joints, step.before + 1,
                     name_of(step.source));
}

std::optional<Place> first_moved(const MeasurementFiles& measured, const StepFound& step) {
  if (measured.tables.empty()) return std::nullopt;
  const RowPlace at = row_place(measured, step.after);
  const Table& table = measured.tables[static_cast<std::size_t>(at.table)];
  const Column* column = table.find(measured.has_axis[0] ? "x" : "y");
  if (column == nullptr) return std::nullopt;
  return place_in_row(table, at.row, *column, "moved from here on");
}

}  // namespace

std::optional<MovedPart> moved_part(const Cell& cell, const MeasurementFiles& measured,
                                    const std::vector<int>& rows, const ArmState& fitted) {
  const std::optional<StepFound> step = main_jump(fitted, measured, rows);
  if (!step) return std::nullopt;
  MovedPart out;
  out.words = fmt::format("{} moved by some {} mm {}", in_words(cell, {step->source, step->joint}),
                          size_in_mm(*step), between(measured, step->before, step->after));
  out.finding = {Severity::kWarning, "W-CHECK-MOVED",
                 fmt::format("it looks as if {}: a fit of all rows lies between the two and is "
                             "wrong for both{}",
                             out.words, uncertainty(measured, *step)),
                 first_moved(measured, *step),
                 fmt::format("look at it: plumb compare; put it into the model: {}; or measure one "
                             "of the two parts again",
                             adding_step(cell, *step))};
  return out;
}

}  // namespace plumb::offline
