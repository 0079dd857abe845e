// SPDX-License-Identifier: Apache-2.0
#include "cell/setups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "cell/artefacts.hpp"
#include "cell/table_place.hpp"
#include "program/problem_list.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCode = "E-CSV-SETUP";

std::vector<std::string> names_of(const MeasurementSettings& m) {
  std::vector<std::string> out;
  for (const auto& setup : m.setups) out.push_back(setup.name);
  return out;
}

int index_of(const MeasurementSettings& m, const std::string& name) {
  for (std::size_t k = 0; k < m.setups.size(); ++k)
    if (m.setups[k].name == name) return static_cast<int>(k);
  return -1;
}

int setup_of_file(const MeasurementSettings& m, const fs::path& file) {
  std::error_code ignored;
  for (std::size_t k = 0; k < m.setups.size(); ++k)
    for (const auto& own : m.setups[k].files)
      if (own == file || fs::weakly_canonical(own, ignored) == file) return static_cast<int>(k);
  return -1;
}

/// The column whose texts name the set-ups of the rows, or null.
const Column* setup_column(const Table& table) {
  return reads_artefact(table) ? artefact_column(table) : table.find_text("setup");
}

/// Finds the set-up of each row of one table.
class Assigner {
 public:
  Assigner(const MeasurementSettings& settings, ProblemList& problems)
      : m_(settings),
        problems_(problems),
        alone_(settings.setups.size() > 1 && !settings.setups[0].is_artefact() &&
               settings.setups[1].is_artefact()) {}

  /// by_file: the set-up that names the file, or -1.
  void assign(const Table& table, int by_file, std::vector<int>& out) {
    const Column* column = setup_column(table);
    int without = 0;
    for (int row = 0; row < table.rows(); ++row) {
      const std::string text = column ? column->text[row] : std::string();
      int setup = by_file;
      if (!text.empty()) setup = said(table, row, *column, by_file);
      if (text.empty() && setup < 0 && alone_) setup = 0;
      if (text.empty() && setup < 0 && without++ == 0) none(table, row, column);
      out.push_back(std::max(0, setup));
    }
  }

 private:
  int said(const Table& table, int row, const Column& column, int by_file) {
    const std::string& text = column.text[row];
    const int setup = index_of(m_, text);
    if (setup < 0 && reported_.insert(table.file + '\n' + text).second) {
      const auto guess = did_you_mean(text, names_of(m_));
      problems_.error(kCode, fmt::format("there is no set-up '{}'", text),
                      place_in_row(table, row, column,
                                   guess ? fmt::format("did you mean '{}'?", *guess)
                                         : "no [[measurement.setup]] has this name"),
                      fmt::format("set-ups of the cell: {}", fmt::join(names_of(m_), ", ")));
    }
    if (setup >= 0 && by_file >= 0 && setup != by_file &&
        reported_.insert(table.file + '\n' + text).second)
      problems_.error(
          kCode,
          fmt::format("this row says set-up '{}', but its file is of set-up '{}'", text,
                      m_.setups[static_cast<std::size_t>(by_file)].name),
          place_in_row(table, row, column, "another set-up"),
          "name the file in 'files' of [measurement] instead, where the column decides");
    return setup;
  }

  void none(const Table& table, int row, const Column* column) {
    problems_.error(kCode,
                    column ? std::string("this row does not say in which set-up it was measured")
                           : fmt::format("{} belongs to no set-up", table.file),
                    column ? place_in_row(table, row, *column, "empty")
                           : place_of_missing(table, "no column 'setup'"),
                    fmt::format("name the file in 'files' of a [[measurement.setup]], or give it a "
                                "column 'setup' with one of: {}",
                                fmt::join(names_of(m_), ", ")));
  }

  const MeasurementSettings& m_;
  ProblemList& problems_;
  bool alone_;  // all rows with positions belong to the first set-up
  std::set<std::string> reported_;
};

/// Readings of one pose in two set-ups are no repeats: if the tracker was moved in between, they
/// differ by much more than the noise.
void keep_repeats_apart(Measurements& measured) {
  std::map<std::pair<int, int>, int> number;
  for (int i = 0; i < measured.size(); ++i) {
    int& group = measured.replicate_group[i];
    group = number.emplace(std::pair(group, measured.setup[i]), static_cast<int>(number.size()))
                .first->second;
  }
}

/// Several names in the column and one frame for all of them: that is rarely meant.
void warn_of_unused_column(MeasurementFiles& measured) {
  std::set<std::string> names;
  Table* first = nullptr;
  for (auto& table : measured.tables)
    if (const Column* column = setup_column(table)) {
      names.insert(column->text.begin(), column->text.end());
      if (first == nullptr) first = &table;
    }
  names.erase("");
  if (names.size() < 2) return;
  const Problem problem{
      Severity::kWarning, "W-CSV-SETUP",
      fmt::format("column 'setup' names {} set-ups, but the cell lists none: one frame and one "
                  "target serve them all",
                  names.size()),
      place_in_header(*first, *setup_column(*first), "not used"),
      fmt::format("list them in cell.toml: [[measurement.setup]] name = \"{}\"", *names.begin())};
  first->remarks.push_back(problem);
}

}  // namespace

int setup_count(const MeasurementSettings& m) {
  return std::max(1, static_cast<int>(m.setups.size()));
}

std::string setup_name(const MeasurementSettings& m, int setup) {
  return m.setups.size() < 2 ? std::string() : m.setups[static_cast<std::size_t>(setup)].name;
}

int frame_root(const MeasurementSettings& m, int setup) {
  while (!m.setups.empty() && m.setups[static_cast<std::size_t>(setup)].frame_of)
    setup = *m.setups[static_cast<std::size_t>(setup)].frame_of;
  return setup;
}

int target_root(const MeasurementSettings& m, int setup) {
  while (!m.setups.empty() && m.setups[static_cast<std::size_t>(setup)].target_of)
    setup = *m.setups[static_cast<std::size_t>(setup)].target_of;
  return setup;
}

Setup setup_rule(const MeasurementSettings& m, int setup) {
  Setup out;
  if (m.setups.empty()) {
    out.fit_frame = m.fit_frame;
    out.X_MB = m.X_MB;
    out.fit_target = m.fit_target;
    out.target_T = m.target_T;
    return out;
  }
  out = m.setups[static_cast<std::size_t>(setup)];
  const Setup& frame = m.setups[static_cast<std::size_t>(frame_root(m, setup))];
  const Setup& target = m.setups[static_cast<std::size_t>(target_root(m, setup))];
  out.fit_frame = frame.fit_frame;
  out.X_MB = frame.X_MB;
  out.fit_target = target.fit_target;
  out.target_T = target.target_T;
  return out;
}

Cell cell_of_setup(const Cell& cell, int setup) {
  Cell out = cell;
  Setup rule = setup_rule(cell.measurement, setup);
  rule.frame_of = rule.target_of = std::nullopt;
  MeasurementSettings& m = out.measurement;
  m.fit_frame = rule.fit_frame;
  m.X_MB = rule.X_MB;
  m.fit_target = rule.fit_target;
  m.target_T = rule.target_T;
  if (!m.setups.empty()) m.setups = {rule};
  return out;
}

OneSetup one_setup(const Cell& cell, const MeasurementFiles& measured, int setup) {
  OneSetup out{setup, cell_of_setup(cell, setup), {}};
  std::vector<int> rows;
  for (int i = 0; i < measured.size(); ++i)
    if (measured.setup.empty() || measured.setup[i] == setup) rows.push_back(i);
  out.measured = pick(measured, rows);
  out.measured.setup.clear();
  return out;
}

int largest_setup(const Cell& cell, const Measurements& measured) {
  std::vector<int> rows(static_cast<std::size_t>(setup_count(cell.measurement)), 0);
  for (const int setup : measured.setup) ++rows[static_cast<std::size_t>(setup)];
  return static_cast<int>(std::max_element(rows.begin(), rows.end()) - rows.begin());
}

std::vector<fs::path> measurement_files(const MeasurementSettings& m) {
  std::vector<fs::path> out = m.files;
  const auto add = [&](const fs::path& file) {
    if (std::find(out.begin(), out.end(), file) == out.end()) out.push_back(file);
  };
  for (const auto& setup : m.setups)
    for (const auto& file : setup.files) add(file);
  if (m.held_out.kind != HeldOutRule::Kind::kFile) return out;
  if (!m.setups.empty()) std::erase(out, m.held_out.file);
  out.push_back(m.held_out.file);
  return out;
}

void assign_setups(const Cell& cell, const std::vector<fs::path>& files,
                   MeasurementFiles& measured) {
  const MeasurementSettings& m = cell.measurement;
  if (m.setups.empty()) return warn_of_unused_column(measured);
  ProblemList problems;
  Assigner assigner(m, problems);
  measured.setup.clear();
  for (std::size_t i = 0; i < measured.tables.size(); ++i)
    assigner.assign(measured.tables[i], setup_of_file(m, files[i]), measured.setup);
  if (problems.errors().empty())
    for (std::size_t k = 0; k < m.setups.size(); ++k)
      if (std::find(measured.setup.begin(), measured.setup.end(), static_cast<int>(k)) ==
          measured.setup.end())
        problems.error(kCode, fmt::format("set-up '{}' has no rows", m.setups[k].name),
                       m.setups[k].place,
                       fmt::format("name its file: files = [\"day1.csv\"], or write '{}' into the "
                                   "column 'setup' of its rows",
                                   m.setups[k].name));
  problems.stop_on_errors();
  keep_repeats_apart(measured);
  assign_placements(m, measured);
}

void assign_setups_to_predict(const Cell& cell, const fs::path& file, MeasurementFiles& rows) {
  const MeasurementSettings& m = cell.measurement;
  rows.setup.clear();
  if (m.setups.size() < 2) return;
  ProblemList problems;
  Assigner assigner(m, problems);
  std::error_code ignored;
  const int by_file = setup_of_file(m, fs::weakly_canonical(file, ignored));
  for (const auto& table : rows.tables) assigner.assign(table, by_file, rows.setup);
  problems.stop_on_errors();
}

}  // namespace plumb::offline
