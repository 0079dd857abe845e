// SPDX-License-Identifier: Apache-2.0
#include "import/importer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "cell/column_names.hpp"
#include "cell/csv_line.hpp"
#include "cell/units.hpp"
#include "import/column_guess.hpp"
#include "import/euler.hpp"
#include "import/moves.hpp"
#include "import/timestamps.hpp"
#include "program/file.hpp"
#include "program/problem_list.hpp"

namespace plumb::offline {
namespace {

constexpr double kStill_rad = 1e-5;  // a joint that moved less stood still

std::string in_words(char sign) {
  switch (sign) {
    case ',':
      return "comma";
    case ';':
      return "semicolon";
    case '\t':
      return "tab";
    case '|':
      return "bar";
    case ' ':
      return "blanks";
    default:
      return "point";
  }
}

/// The digits of a number with a decimal point, thousands signs gone.
std::string plain_number(std::string_view cell, char decimal) {
  std::string out;
  for (char c : cell) {
    if (c == decimal)
      out += '.';
    else if (!(decimal == ',' && c == '.'))
      out += c;
  }
  return out;
}

class Importer {
 public:
  Importer(const SourceText& text, const RawRows& rows, const ImportWishes& wishes)
      : text_(text), rows_(rows), wishes_(wishes) {}

  Imported run() {
    auto plans = plan_columns(rows_.dialect.header, rows_.dialect.units, wishes_.map);
    out_.file = text_.file;
    out_.sha256 = text_.sha256;
    out_.separator = in_words(rows_.dialect.separator);
    out_.decimal = in_words(rows_.dialect.decimal);
    out_.lines = rows_.lines;
    out_.comments = rows_.comments;
    out_.remarks = text_.remarks;
    out_.remarks.insert(out_.remarks.end(), rows_.remarks.begin(), rows_.remarks.end());
    look_at_units(plans);
    for (std::size_t k = 0; k < plans.size(); ++k) {
      if (plans[k].name.empty())
        out_.left_out.push_back(plans[k].from);
      else if (plans[k].name == "time")
        add_times(plans[k], k);
      else if (unitless_quantity(plans[k].name) == Quantity::kText)
        add_texts(plans[k], k);
      else
        add_numbers(plans[k], k);
    }
    refuse_if_nothing_is_known();
    problems_.stop_on_errors();
    turn_to_quaternions();
    say_what_was_left_out();
    return std::move(out_);
  }

 private:
  /// A recognised column must say its unit, and one that plumb knows; a preview only warns.
  void look_at_units(std::vector<ColumnPlan>& plans) {
    for (auto& plan : plans) {
      if (!plan.lacks_unit && plan.foreign.empty()) continue;
      const Problem problem = plan.foreign.empty() ? unitless(plan) : of_another_unit(plan);
      if (wishes_.preview)
        out_.remarks.push_back(problem), plan.unit = "?";
      else
        problems_.add(problem);
    }
    problems_.stop_on_errors();
  }

  /// A file of which no column was understood would be written empty.
  void refuse_if_nothing_is_known() {
    if (!out_.columns.empty() || !problems_.errors().empty() || wishes_.preview) return;
    const int line = std::max(rows_.dialect.header_line, 1);
    problems_.error("E-IMPORT-HEADER", "none of the columns is known",
                    Place{.file = text_.file,
                          .line = line,
                          .column = 1,
                          .source = std::string(text_.lines[line - 1]),
                          .label = "taken as the header"},
                    fmt::format("say what they are: --map \"{}=q1_deg\"",
                                rows_.dialect.header.empty() ? "NAME" : rows_.dialect.header[0]));
  }

  Problem unitless(const ColumnPlan& plan) const {
    return of_unit(plan, fmt::format("column '{}' has no unit", plan.from),
                   fmt::format("taken as '{}'", plan.name),
                   fmt::format("--map \"{}={}_{}\"", plan.from, plan.name, usual_unit(plan.name)));
  }

  Problem of_another_unit(const ColumnPlan& plan) const {
    const ForeignUnit& unit = *foreign_unit(plan.foreign);
    return of_unit(plan,
                   fmt::format("column '{}' is in {}, which is none of plumb's units", plan.from,
                               plan.foreign),
                   std::string(unit.equals),
                   fmt::format("convert the numbers and name the column {}_{}, or leave it out: "
                               "--map \"{}=-\"",
                               plan.name, unit.use, plan.from));
  }

  Problem of_unit(const ColumnPlan& plan, std::string message, std::string label,
                  std::string help) const {
    const int line = std::max(rows_.dialect.header_line, 1);
    const std::string source(text_.lines[line - 1]);
    const auto column = std::min(source.find(plan.from), source.size());
    return {.severity = wishes_.preview ? Severity::kWarning : Severity::kError,
            .code = wishes_.preview ? "W-IMPORT-UNIT" : "E-IMPORT-UNIT",
            .message = std::move(message),
            .place = Place{.file = text_.file,
                           .line = line,
                           .column = static_cast<int>(column) + 1,
                           .length = static_cast<int>(plan.from.size()),
                           .source = source,
                           .label = std::move(label)},
            .help = std::move(help)};
  }

  void add_texts(const ColumnPlan& plan, std::size_t k) {
    ImportedColumn column{plan.from, plan.name, "", {}};
    for (const auto& row : rows_.cells) column.text.emplace_back(row[k]);
    out_.columns.push_back(std::move(column));
  }

  void add_numbers(const ColumnPlan& plan, std::size_t k) {
    const char decimal = rows_.dialect.decimal;
    ImportedColumn column{plan.from, plan.name, plan.unit, {}};
    column.text.reserve(rows_.cells.size());
    for (std::size_t i = 0; i < rows_.cells.size(); ++i) {
      const auto cell = rows_.cells[i][k];
      if (!number_in(cell, decimal)) bad_number(plan, i, cell);
      column.text.push_back(plain_number(cell, decimal));
    }
    out_.columns.push_back(std::move(column));
  }

  void bad_number(const ColumnPlan& plan, std::size_t i, std::string_view cell) {
    const int line = rows_.lines[i];
    const auto source = text_.lines[line - 1];
    problems_.error(
        "E-IMPORT-NUMBER", fmt::format("column '{}' holds '{}', not a number", plan.from, cell),
        Place{.file = text_.file,
              .line = line,
              .column = static_cast<int>(cell.data() - source.data()) + 1,
              .length = std::max(1, static_cast<int>(cell.size())),
              .source = std::string(source),
              .label = "not a number"},
        fmt::format("correct or delete the row; to leave the column out: --map \"{}=-\"",
                    plan.from));
  }

  void add_times(const ColumnPlan& plan, std::size_t k) {
    std::vector<std::string_view> cells;
    for (const auto& row : rows_.cells) cells.push_back(row[k]);
    const Timestamps times = read_timestamps(cells, rows_.dialect.decimal);
    if (times.seconds.empty()) {
      const int line = rows_.lines[std::min(times.damaged_row, rows_.lines.size() - 1)];
      out_.remarks.push_back(
          {.severity = Severity::kWarning,
           .code = "W-IMPORT-TIME",
           .message = fmt::format("the time stamps in '{}' are lost: {}", plan.from, times.damage),
           .place = Place{.file = text_.file,
                          .line = line,
                          .column = 1,
                          .source = std::string(text_.lines[line - 1]),
                          .label = "from here on"},
           .help = "export again without opening the file in a spreadsheet"});
      out_.left_out.push_back(plan.from);
      return;
    }
    ImportedColumn column{plan.from, "t", "s", {}};
    for (double t : times.seconds) column.text.push_back(fmt::format("{:.6g}", t));
    for (std::size_t i = 0; i < times.seconds.size(); ++i)
      if (times.seconds[i] > 1e5) column.text[i] = fmt::format("{:.3f}", times.seconds[i]);
    out_.columns.push_back(std::move(column));
    if (times.wrapped)
      out_.remarks.push_back(
          {.severity = Severity::kNote,
           .code = "N-IMPORT-MIDNIGHT",
           .message = fmt::format("the clock in '{}' passed midnight", plan.from),
           .help = "a day was added"});
  }

  static double value_of(const ImportedColumn& column, std::size_t i) {
    double value = 0.0;
    const auto& text = column.text[i];
    std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), text.data() + text.size(),
                    value);
    return unit_of(column.unit)->to_si(value);
  }

  /// rx, ry, rz mean nothing without the order of the turns.
  void turn_to_quaternions() {
    std::array<const ImportedColumn*, 3> turns{out_.find("rx"), out_.find("ry"), out_.find("rz")};
    if (turns[0] == nullptr || turns[1] == nullptr || turns[2] == nullptr) return;
    if (turns[0]->unit == "?") return;
    std::vector<ImportedColumn> quat;
    if (wishes_.rotation.empty()) {
      out_.remarks.push_back(
          {.severity = Severity::kNote,
           .code = "N-IMPORT-ROT",
           .message = "rx, ry, rz were left out: the order of the turns is not known",
           .help = "--rot xyz-fixed if R = Rz Ry Rx, --rot xyz-moving if R = Rx Ry Rz"});
    } else {
      const EulerConvention convention = euler_convention(wishes_.rotation);
      for (const char* name : {"qw", "qx", "qy", "qz"}) quat.push_back({"", name, "", {}});
      for (std::size_t i = 0; i < rows_.cells.size(); ++i) {
        const auto q = quaternion(
            convention, {value_of(*turns[0], i), value_of(*turns[1], i), value_of(*turns[2], i)});
        for (std::size_t k = 0; k < 4; ++k) quat[k].text.push_back(fmt::format("{:.12g}", q[k]));
      }
    }
    std::erase_if(out_.columns, [](const ImportedColumn& c) {
      return c.name == "rx" || c.name == "ry" || c.name == "rz";
    });
    for (auto& column : quat) out_.columns.push_back(std::move(column));
  }

  void say_what_was_left_out() {
    if (out_.left_out.empty()) return;
    out_.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-IMPORT-LEFT",
         .message = fmt::format("columns left out: {}", fmt::join(out_.left_out, ", ")),
         .help = fmt::format("to keep one: --map \"{}=NAME_UNIT\"", out_.left_out.front())});
  }

  const SourceText& text_;
  const RawRows& rows_;
  const ImportWishes& wishes_;
  ProblemList problems_;
  Imported out_;
};

int order_of(const std::string& name) {
  static const std::vector<std::string> kFirst{"pose", "repeat", "set"};
  if (const auto at = std::find(kFirst.begin(), kFirst.end(), name); at != kFirst.end())
    return static_cast<int>(at - kFirst.begin());
  if (const int j = joint_number(name, "q"); j > 0) return 10 + j;
  if (const int j = joint_number(name, "qc"); j > 0) return 30 + j;
  static const std::vector<std::string> kPoint{"x",  "y",  "z",  "qw", "qx", "qy", "qz",
                                               "sx", "sy", "sz", "nx", "ny", "nz"};
  const auto at = std::find(kPoint.begin(), kPoint.end(), name);
  return at != kPoint.end() ? 50 + static_cast<int>(at - kPoint.begin()) : 100;
}

}  // namespace

Imported import_file(const std::filesystem::path& file, const ImportWishes& wishes) {
  SourceText text;
  decode(read_file(file), display_name(file), text);
  const RawRows rows = cut(text, wishes.dialect);
  return Importer(text, rows, wishes).run();
}

void add_directions(Imported& data) {
  std::vector<ImportedColumn> more;
  for (int j = 1; const ImportedColumn* q = data.find("q" + std::to_string(j)); ++j) {
    std::vector<double> values;
    for (const auto& text : q->text) {
      double value = 0.0;
      std::from_chars(text.data(), text.data() + text.size(), value);
      values.push_back(value);
    }
    const auto unit = *unit_of(q->unit);
    const Arrivals arrivals = arrivals_from_order(values, unit.from_si(kStill_rad));
    ImportedColumn direction{"", fmt::format("dir_j{}", j), "", {}};
    ImportedColumn travel{"", fmt::format("travel_j{}", j), q->unit, {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
      direction.text.push_back(std::to_string(arrivals.direction[i]));
      travel.text.push_back(fmt::format("{:.9g}", arrivals.travel[i]));
    }
    more.push_back(std::move(direction));
    more.push_back(std::move(travel));
  }
  for (auto& column : more) data.columns.push_back(std::move(column));
}

std::string imported_csv(const Imported& data) {
  std::vector<const ImportedColumn*> columns;
  for (const auto& column : data.columns) columns.push_back(&column);
  std::stable_sort(columns.begin(), columns.end(),
                   [](const ImportedColumn* a, const ImportedColumn* b) {
                     return order_of(a->name) < order_of(b->name);
                   });
  std::string out;
  out.reserve(static_cast<std::size_t>(data.rows()) * columns.size() * 12);
  for (const auto& [key, value] : data.comments)
    if (key != "rot") out += fmt::format("# {}: {}\n", key, value);
  out += fmt::format("# imported from: {}\n", std::filesystem::path(data.file).filename().string());
  for (std::size_t k = 0; k < columns.size(); ++k)
    out += (k > 0 ? "," : "") + columns[k]->heading();
  out += '\n';
  for (int i = 0; i < data.rows(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (k > 0) out += ',';
      const std::string& text = columns[k]->text[i];
      if (unitless_quantity(columns[k]->name) == Quantity::kText)
        out += quoted_if_needed(text);
      else
        out += text;
    }
    out += '\n';
  }
  return out;
}

}  // namespace plumb::offline
