// SPDX-License-Identifier: Apache-2.0
#include "cell/measurement_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "cell/arm_columns.hpp"
#include "cell/arm_reach.hpp"
#include "cell/artefacts.hpp"
#include "cell/contexts.hpp"
#include "cell/last_moves.hpp"
#include "cell/measurement_warnings.hpp"
#include "cell/replicates.hpp"
#include "cell/table_file.hpp"
#include "cell/table_place.hpp"

namespace plumb::offline {
namespace {

class Assembler {
 public:
  Assembler(const JointColumns& joints, Needs needs) : joints_(joints), needs_(needs) {}

  void read(const std::filesystem::path& file) {
    try {
      tables_.push_back(read_table(file));
    } catch (const Failure& failure) {
      for (const auto& problem : failure.problems()) problems_.add(problem);
    }
  }

  void take(Table table) { tables_.push_back(std::move(table)); }

  /// The steps that need much memory for a moment stand first, before the context is read.
  MeasurementFiles finish() {
    join();
    m_.replicate_group = replicate_groups(names(), file_, m_.q);
    for (auto& table : tables_) {
      warn_of_misspelt(table);
      warn_of_values(table);
      warn_of_doubles(table);
    }
    m_.context = read_contexts(tables_, m_.q);
    if (needs_ == Needs::kJoints) forget_order(tables_, m_.q, m_.context);
    m_.file = file_of_rows(tables_);
    m_.tables = std::move(tables_);
    warn_of_names(m_);
    replace_zero_sigmas(m_);
    return std::move(m_);
  }

  /// For rows that are only predicted, not fitted: repeats and copies are not looked for.
  MeasurementFiles finish_plainly() {
    join();
    m_.context = read_contexts(tables_, m_.q);
    forget_order(tables_, m_.q, m_.context);
    for (auto& table : tables_) {
      warn_of_misspelt(table);
      warn_of_values(table);
    }
    m_.file = file_of_rows(tables_);
    m_.tables = std::move(tables_);
    return std::move(m_);
  }

 private:
  /// All that the tables say, or a Failure with all that is wrong.
  void join() {
    for (const auto& table : tables_)
      columns_.push_back(find_arm_columns(table, joints_.is_angle, needs_, problems_));
    for (std::size_t i = 0; i < tables_.size(); ++i)
      check_reach(tables_[i], columns_[i], problems_);
    check_agreement();
    fill_if_sound();
    problems_.stop_on_errors();
  }

  /// The files with positions must have the same measured axes. Other columns that some files lack
  /// are dropped.
  void check_agreement() {
    const std::size_t with = first_with_positions();
    for (std::size_t i = with + 1; i < tables_.size(); ++i)
      for (int k = 0; k < 3 && !reads_artefact(tables_[i]); ++k)
        agree(with, i, "xyz"[k], columns_[with].p[k], columns_[i].p[k]);
    drop_unless_everywhere(
        "orientation", [](ArmColumns& c) { return c.has_orientation(); },
        [](ArmColumns& c) { c.quat = {}, c.turns = {}; });
    drop_unless_everywhere(
        "sx, sy, sz", [](ArmColumns& c) { return given(c.sigma); },
        [](ArmColumns& c) { c.sigma = {}; });
    drop_unless_everywhere(
        "nx, ny, nz", [](ArmColumns& c) { return given(c.nominal); },
        [](ArmColumns& c) { c.nominal = {}; });
  }

  static bool given(const AxisColumns& columns) { return columns != AxisColumns{}; }

  /// The first table whose rows have measured positions; how many tables there are if none has.
  std::size_t first_with_positions() const {
    return static_cast<std::size_t>(
        std::find_if_not(tables_.begin(), tables_.end(), reads_artefact) - tables_.begin());
  }

  void agree(std::size_t with, std::size_t i, char axis, bool first, bool here) {
    if (first == here) return;
    const Table& lacks = first ? tables_[i] : tables_[with];
    const Table& has = first ? tables_[with] : tables_[i];
    problems_.error("E-CSV-MIXED", fmt::format("axis {} is measured in {} only", axis, has.file),
                    place_of_missing(lacks, fmt::format("'{}_mm' is missing", axis)),
                    "give all files of one cell the same measured axes");
  }

  void drop_unless_everywhere(const char* what, auto has, auto drop) {
    int holders = 0;
    for (auto& columns : columns_) holders += has(columns) ? 1 : 0;
    if (holders == 0 || holders == static_cast<int>(columns_.size())) return;
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (!has(columns_[i]))
        tables_[i].remarks.push_back({Severity::kWarning, "W-CSV-MIXED",
                                      fmt::format("{} not used: not every file has it", what),
                                      place_of_missing(tables_[i], "missing here"),
                                      "complete this file, or delete the columns from the others"});
    for (auto& columns : columns_) drop(columns);
  }

  void fill_if_sound() {
    if (!problems_.errors().empty()) return;
    int rows = 0;
    for (const auto& table : tables_) rows += table.rows();
    shape(rows);
    int first = 0;
    for (std::size_t i = 0; i < tables_.size(); ++i) {
      fill(tables_[i], columns_[i], first);
      file_.insert(file_.end(), tables_[i].rows(), static_cast<int>(i));
      first += tables_[i].rows();
    }
    to_angles(joints_.coupling, m_.q);
  }

  void shape(int rows) {
    const auto joints = static_cast<Eigen::Index>(joints_.is_angle.size());
    const ArmColumns none;
    const ArmColumns& c = columns_.empty() ? none : columns_.front();
    m_.q.resize(rows, joints);
    m_.p_M = Rows3::Zero(rows, 3);
    m_.quat_M.resize(c.has_orientation() ? rows : 0, 4);
    m_.sigma_m = Rows3::Zero(given(c.sigma) ? rows : 0, 3);
    m_.nominal_B = Rows3::Zero(given(c.nominal) ? rows : 0, 3);
    if (std::any_of(tables_.begin(), tables_.end(), reads_artefact))
      m_.kind.resize(static_cast<std::size_t>(rows), ReadingKind::kPosition);
    if (!tables_.empty()) m_.has_axis = axes();
    m_.pose.reserve(rows);
    m_.set.reserve(rows);
    file_.reserve(rows);
  }

  /// The axes of measured positions; without any, those that a reading of an artefact has.
  std::array<bool, 3> axes() const {
    std::array<bool, 3> out{};
    const std::size_t with = first_with_positions();
    for (std::size_t k = 0; k < 3; ++k)
      out[k] = with < tables_.size()
                   ? columns_[with].p[k] != nullptr
                   : std::any_of(tables_.begin(), tables_.end(), [&](const Table& table) {
                       return descriptor_of(kind_of(table)).reads[k];
                     });
    return out;
  }

  void fill(Table& table, const ArmColumns& c, int first) {
    for (int row = 0; row < table.rows(); ++row)
      for (std::size_t k = 0; k < c.q.size(); ++k) m_.q(first + row, k) = c.q[k]->values[row];
    copy(table, c.p, first, m_.p_M);
    if (reads_artefact(table)) fill_readings(table, first);
    copy(table, c.sigma, first, m_.sigma_m);
    copy(table, c.nominal, first, m_.nominal_B);
    name_rows(table, c.pose, first);
    for (int row = 0; row < table.rows(); ++row) {
      m_.set.push_back(mark(table, c.set, row));
      if (!c.has_orientation()) continue;
      const auto q = orientation(table, c, row, problems_);
      m_.quat_M.row(first + row) << q[0], q[1], q[2], q[3];
    }
  }

  void fill_readings(const Table& table, int first) {
    const ReadingDescriptor& kind = descriptor_of(kind_of(table));
    const Column* value = value_column(table);
    for (int row = 0; row < table.rows(); ++row) {
      m_.kind[static_cast<std::size_t>(first + row)] = kind.kind;
      for (int k = 0; k < 3 && value != nullptr; ++k)
        if (kind.reads[static_cast<std::size_t>(k)]) m_.p_M(first + row, k) = value->values[row];
    }
  }

  /// Takes the texts of the column: no one reads them from the table.
  void name_rows(Table& table, const Column* pose, int first) {
    for (int row = 0; pose == nullptr && row < table.rows(); ++row)
      m_.pose.push_back(std::to_string(first + row + 1));
    for (auto& column : table.columns) {
      if (&column != pose) continue;
      std::move(column.text.begin(), column.text.end(), std::back_inserter(m_.pose));
      column.text = {};
    }
  }

  /// As written; empty where no column names the rows.
  std::vector<std::string_view> names() const {
    std::vector<std::string_view> out(m_.pose.begin(), m_.pose.end());
    for (std::size_t row = 0; row < out.size(); ++row)
      if (columns_[static_cast<std::size_t>(file_[row])].pose == nullptr) out[row] = {};
    return out;
  }

  static void copy(const Table& table, const AxisColumns& from, int first, Rows3& to) {
    for (int k = 0; k < 3; ++k)
      for (int row = 0; from[k] != nullptr && to.rows() > 0 && row < table.rows(); ++row)
        to(first + row, k) = from[k]->values[row];
  }

  SetMark mark(const Table& table, const Column* set, int row) {
    if (set == nullptr || set->text[row].empty()) return SetMark::kUnmarked;
    const std::string& text = set->text[row];
    if (text == "fit") return SetMark::kFit;
    if (text == "held") return SetMark::kHeld;
    if (text == "ignore") return SetMark::kIgnore;
    problems_.error("E-CSV-SET", fmt::format("column 'set' holds '{}'", text),
                    place_in_row(table, row, *set, "not one of the three"),
                    "write fit, held or ignore");
    return SetMark::kUnmarked;
  }
  const JointColumns& joints_;
  Needs needs_;
  std::vector<Table> tables_;
  std::vector<ArmColumns> columns_;
  ProblemList problems_;
  std::vector<int> file_;  // of each row
  MeasurementFiles m_;
};

}  // namespace

MeasurementFiles read_measurements(const std::vector<std::filesystem::path>& files,
                                   const JointColumns& joints, Needs needs) {
  if (files.empty())
    throw Failure(Exit::kInput,
                  Problem{.code = "E-CSV-NONE",
                          .message = "no measurement file is named",
                          .help = "set [measurement] files = [\"measurements.csv\"]"});
  Assembler assembler(joints, needs);
  for (const auto& file : files) assembler.read(file);
  return assembler.finish();
}

MeasurementFiles plain_rows(Table table, const JointColumns& joints) {
  Assembler assembler(joints, Needs::kJoints);
  assembler.take(std::move(table));
  return assembler.finish_plainly();
}

}  // namespace plumb::offline
