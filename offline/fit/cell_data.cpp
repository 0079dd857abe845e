// SPDX-License-Identifier: Apache-2.0
#include "fit/cell_data.hpp"
#include "fit/distance_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "cell/artefacts.hpp"
#include "cell/earlier_arm.hpp"
#include "cell/lost_points.hpp"
#include "cell/measurement_reader.hpp"
#include "cell/reading_digest.hpp"
#include "cell/setups.hpp"
#include "cell/table_place.hpp"
#include "effects/effect_option.hpp"
#include "fit/constants.hpp"
#include "plumb/runtime/chain.hpp"
#include "program/file.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

/// False if the tool point stays in one plane: all turning joints have parallel axes, and all
/// sliding joints move perpendicular to these.
bool moves_in_space(const Cell& cell) {
  const Chain chain(cell.nominal);
  const std::vector<double> zero(static_cast<std::size_t>(chain.joints()), 0.0);
  ChainAxes axes;
  chain.frames(zero, axes);
  const auto axis = [&](int j) {
    const auto& z = axes.joint[static_cast<std::size_t>(j)].along;
    return Vector3(z[0], z[1], z[2]);
  };
  std::optional<Vector3> turning;
  for (int j = 0; j < chain.joints(); ++j)
    if (chain.revolute(j) && !turning) turning = axis(j);
  if (!turning) return true;
  for (int j = 0; j < chain.joints(); ++j) {
    const double along = dot(*turning, axis(j));
    const double across = 1.0 - along * along;
    if (chain.revolute(j) ? across > kParallel_rad * kParallel_rad
                          : std::abs(along) > kParallel_rad)
      return true;
  }
  return false;
}

/// W-CSV-AXES: an error of one direction looks smaller than that of the point in space.
void warn_of_single_lines(const Measurements& measured, Table& table) {
  for (int i = 0; i < measured.size(); ++i)
    if (measured.axes(i) > 1) return;
  table.remarks.push_back(
      {Severity::kWarning, "W-CSV-AXES",
       "each reading is one number, how far the tool is from a plane or a centre: every error is "
       "along that direction alone",
       place_in_header(table, *artefact_column(table), "says one number a row"),
       "where the directions vary, the error in space is about 1.7 times as large"});
}

/// W-CSV-AXES: an error of two axes looks smaller than that of the point in space.
void warn_of_missing_axes(const Cell& cell, MeasurementFiles& measured) {
  const auto first_positions =
      std::find_if_not(measured.tables.begin(), measured.tables.end(), reads_artefact);
  if (measured.tables.empty()) return;
  if (first_positions == measured.tables.end())
    return warn_of_single_lines(measured, measured.tables.front());
  std::string missing, given;
  for (int k = 0; k < 3; ++k) {
    std::string& list = measured.has_axis[k] ? given : missing;
    list += (list.empty() ? "" : " and ") + std::string(1, "xyz"[k]);
  }
  if (missing.empty() || given.empty() || !moves_in_space(cell)) return;
  Table& table = *first_positions;
  const std::string first(1, missing.front());
  table.remarks.push_back(
      {Severity::kWarning, "W-CSV-AXES",
       fmt::format("{} not measured, though the arm moves in space: every error is of {} alone",
                   missing + (missing.size() > 1 ? " are" : " is"), given),
       place_of_missing(table, fmt::format("no '{}_mm'", first)),
       fmt::format("if the file has it under another name: plumb import {} --map NAME={}_mm",
                   table.file, first)});
}

/// A file in the folder of `file` whose name is similar.
std::optional<std::string> neighbour_like(const fs::path& file) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(file.parent_path(), ignored))
    if (entry.is_regular_file(ignored)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return did_you_mean(file.filename().string(), names);
}

Problem no_such_file(const Cell& cell, const fs::path& file, Place place) {
  if (place.file.empty()) place.file = display_name(cell.file);
  const auto guess = neighbour_like(file);
  if (guess) place.label = fmt::format("did you mean '{}'?", *guess);
  return {.code = "E-READ",
          .message = fmt::format("cannot read {}: no such file", display_name(file)),
          .place = std::move(place),
          .help = guess ? fmt::format("write \"{}\"", (file.parent_path() / *guess)
                                                          .lexically_proximate(cell.directory)
                                                          .generic_string())
                        : "see what is there: ls -l " + file.parent_path().string()};
}

/// Throws E-READ for every file that the cell names and that does not exist, with the line of
/// cell.toml that names it.
void check_files(const Cell& cell) {
  std::vector<Problem> problems;
  std::error_code ignored;
  const auto& m = cell.measurement;
  for (std::size_t i = 0; i < m.files.size(); ++i)
    if (!fs::exists(m.files[i], ignored))
      problems.push_back(
          no_such_file(cell, m.files[i], i < m.named_at.size() ? m.named_at[i] : Place{}));
  for (const auto& setup : m.setups)
    for (std::size_t i = 0; i < setup.files.size(); ++i)
      if (!fs::exists(setup.files[i], ignored))
        problems.push_back(no_such_file(cell, setup.files[i],
                                        i < setup.named_at.size() ? setup.named_at[i] : Place{}));
  if (m.held_out.kind == HeldOutRule::Kind::kFile && !fs::exists(m.held_out.file, ignored))
    problems.push_back(no_such_file(cell, m.held_out.file, m.held_out.named_at));
  if (!problems.empty()) throw Failure(Exit::kInput, std::move(problems));
}

}  // namespace

/// Throws E-FIT-EARLIER if the earlier run was fitted to readings of this fit, which would count
/// twice.
void check_earlier(const Cell& cell, const MeasurementFiles& measured) {
  if (!cell.fit.earlier) return;
  const EarlierArm& earlier = *cell.fit.earlier;
  const int known = count_known(measured, earlier.readings);
  const bool of_a_file =
      std::any_of(measured.tables.begin(), measured.tables.end(), [&](const Table& table) {
        return std::find(earlier.inputs.begin(), earlier.inputs.end(), table.sha256) !=
               earlier.inputs.end();
      });
  if (known < kSeenShare * measured.size() && !of_a_file) return;
  throw Failure(
      Exit::kInput,
      {.code = "E-FIT-EARLIER",
       .message = fmt::format("{} goes back to {} of these {} readings, which would count twice",
                              display_name(earlier.run),
                              known > 0 ? fmt::format("{}", known) : "some", measured.size()),
       .help = "name readings that it has not seen: plumb fit --from RUN --data later.csv"});
}

MeasurementFiles read_cell_measurements(Cell& cell) {
  check_files(cell);
  const auto files = measurement_files(cell.measurement);
  MeasurementFiles out = read_measurements(files, cell.nominal, Needs::kJointsAndPosition);
  list_artefacts(out.tables, cell.measurement);
  assign_setups(cell, files, out);
  ignore_lost_points(cell, out);
  check_rows(cell, out);
  warn_of_missing_axes(cell, out);
  warn_of_distance_unit(cell, out);
  check_earlier(cell, out);
  return out;
}

void check_rows(const Cell& cell, const Measurements& measured) {
  std::vector<Problem> problems;
  for (const auto& effect : cell.effects) {
    const double row = number_option(effect, OptionKey::kAfterRow, -1.0);
    if (row < measured.size()) continue;
    problems.push_back(
        {.code = "E-EFFECT-DATA",
         .message = fmt::format("effect '{}' begins behind row {:g}, but the last of "
                                "the measurements is row {}",
                                effect.name, row, measured.size()),
         .place = effect.place,
         .help = fmt::format("after_row = {}   # or less", std::max(1, measured.size() - 1))});
  }
  if (!problems.empty()) throw Failure(Exit::kInput, std::move(problems));
}

}  // namespace plumb::offline
