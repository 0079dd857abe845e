// SPDX-License-Identifier: Apache-2.0
#include "import/importer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "cell/column_names.hpp"
#include "cell/units.hpp"
#include "import/cell_time.hpp"
#include "import/cells.hpp"
#include "import/column_guess.hpp"
#include "import/content.hpp"
#include "import/euler.hpp"
#include "import/heading.hpp"
#include "import/map_option.hpp"
#include "import/number_text.hpp"
#include "import/plan_remarks.hpp"
#include "import/planned_units.hpp"
#include "import/pose_matrix.hpp"
#include "import/radians.hpp"
#include "import/timestamps.hpp"
#include "import/transposed.hpp"
#include "import/unit_questions.hpp"
#include "import/words.hpp"
#include "program/file.hpp"
#include "program/problem_list.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kShownLines = 10;

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
    case '=':
      return "keywords";
    default:
      return "point";
  }
}

class Importer {
 public:
  Importer(const SourceText& text, RawRows rows, const ImportWishes& wishes)
      : text_(text), rows_(std::move(rows)), wishes_(wishes) {}

  Imported run() {
    for (auto& problem : rows_.faults) problems_.add(std::move(problem));
    contents_ = column_contents(rows_);
    std::vector<Problem> decisions;
    std::vector<std::string> columns = rows_.dialect.header;
    columns.insert(columns.end(), wishes_.elsewhere.begin(), wishes_.elsewhere.end());
    auto plans =
        plan_columns(rows_.dialect.header, rows_.dialect.units, contents_,
                     wishes_of(wishes_.map, columns), wishes_.elsewhere, wishes_.joints, decisions);
    out_.file = text_.file;
    out_.inputs = {{text_.file, text_.sha256}};
    out_.separator = in_words(rows_.dialect.separator);
    out_.decimal = in_words(rows_.dialect.decimal);
    out_.comments = rows_.comments;
    out_.remarks = text_.remarks;
    out_.remarks.insert(out_.remarks.end(), rows_.remarks.begin(), rows_.remarks.end());
    out_.remarks.insert(out_.remarks.end(), decisions.begin(), decisions.end());
    if (wishes_.skip_bad) skip_bad_rows(plans);
    out_.lines = std::move(rows_.lines);
    cells_ = std::make_shared<CellTable>(std::move(rows_.cells));
    leave_out_empty(plans);
    join_date_and_time(plans);
    join_seconds(plans);
    matrix_ = take_matrix(plans, contents_, out_.remarks);
    if (matrix_) {
      for (const auto& row : matrix_->at) used_.insert(used_.end(), row.begin(), row.end() - 1);
      used_.insert(used_.end(), matrix_->last_row.begin(), matrix_->last_row.end());
    }
    take_stated_units(rows_.stated, text_.file, plans, out_.remarks);
    look_at_units(plans);
    say_of_uncertainties(plans, out_.remarks);
    say_of_sliding(plans, out_.remarks);
    const auto orientation = matrix_ && matrix_->turns
                                 ? orientation_of(*matrix_, *cells_, rows_.dialect.decimal)
                                 : std::vector<ImportedColumn>{};
    for (std::size_t k = 0; k < plans.size(); ++k) {
      if (plans[k].name.empty())
        leave_out(plans[k], k);
      else if (plans[k].name == "time")
        add_times(plans[k], k);
      else if (unitless_quantity(plans[k].name) == Quantity::kText)
        add_texts(plans[k], k);
      else
        add_numbers(plans[k], k);
    }
    problems_.stop_on_errors();
    for (std::size_t k = 0; k < plans.size(); ++k)
      if (holds_numbers(plans[k])) write_plainly(plans[k], k);
    write_times();
    say_of_thousands();
    say_of_radians(plans, contents_, out_);
    turn_to_quaternions(wishes_.rotation, out_);
    out_.columns.insert(out_.columns.end(), orientation.begin(), orientation.end());
    say_what_was_left_out();
    return std::move(out_);
  }

 private:
  void leave_out(const ColumnPlan& plan, std::size_t k) {
    if (std::find(used_.begin(), used_.end(), k) != used_.end()) return;
    out_.left_out.push_back(plan.from.empty() ? fmt::format("column {}", k + 1) : plan.from);
    if (out_.left_out.size() == 1 && !contents_[k].numeric() && !contents_[k].empty)
      kept_as_ = "=note";
    const bool of_quaternion = plan.named.letter_q || plan.named.quaternion_part;  // said elsewhere
    if (!plan.wished && !of_quaternion && contents_[k].numeric() && !plan.from.empty())
      out_.unused.push_back({plan.from, contents_[k].largest});
  }

  static bool holds_numbers(const ColumnPlan& plan) {
    return !plan.name.empty() && plan.name != "time" && plan.name != "date" &&
           unitless_quantity(plan.name) != Quantity::kText;
  }

  /// Leaves out the rows with a cell that should be a number and is none: no measurement was made
  /// there. Columns without any number are no reason.
  void skip_bad_rows(const std::vector<ColumnPlan>& plans) {
    std::vector<std::string> lines;
    std::size_t skipped = 0;
    rows_.keep_rows([&](std::size_t i) {
      bool bad = false;
      for (std::size_t k = 0; k < plans.size() && !bad; ++k)
        bad = holds_numbers(plans[k]) && !contents_[k].empty &&
              !number_in(rows_.cells[i][k], rows_.dialect.decimal);
      if (bad && ++skipped <= kShownLines) lines.push_back(fmt::format("{}", rows_.lines[i]));
      return !bad;
    });
    if (skipped == 0) return;
    if (skipped > lines.size()) lines.push_back(fmt::format("{} more", skipped - lines.size()));
    out_.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-IMPORT-SKIPPED",
         .message = fmt::format("{} without a measurement left out: line{} {}",
                                skipped == 1 ? "1 row" : fmt::format("{} rows", skipped),
                                skipped == 1 ? "" : "s", fmt::join(lines, ", ")),
         .help = "measure there again"});
    if (rows_.cells.empty())
      throw Failure(Exit::kInput, {.code = "E-IMPORT-ROWS",
                                   .message = "no row has a number in every column",
                                   .place = Place{.file = text_.file},
                                   .help = "leave a column out with --map \"NAME=-\""});
  }

  /// Leaves out known columns that are empty in every row; they are no errors.
  void leave_out_empty(std::vector<ColumnPlan>& plans) {
    for (std::size_t k = 0; k < plans.size(); ++k) {
      if (!contents_[k].empty || plans[k].name.empty() || plans[k].wished) continue;
      if (unitless_quantity(plans[k].name) == Quantity::kText) continue;
      plans[k].name.clear();
      plans[k].lacks_unit = false;
      plans[k].foreign.clear();
    }
  }

  /// A date in one column and the time of day in another are one time stamp.
  void join_date_and_time(std::vector<ColumnPlan>& plans) {
    const auto find = [&](const char* name) {
      const auto at = std::find_if(plans.begin(), plans.end(),
                                   [&](const ColumnPlan& plan) { return plan.name == name; });
      return at == plans.end() ? nullptr : &*at;
    };
    ColumnPlan *date = find("date"), *time = find("time");
    if (date == nullptr) return;
    if (time == nullptr) {
      date->name = "time";
      return;
    }
    date_column_ = static_cast<std::size_t>(date - plans.data());
    time->from = date->from + "' and '" + time->from;
    date->name.clear();
    joined_date_ = true;
  }

  /// A column called time holds stamps, or numbers that count from some start.
  void look_at_time(ColumnPlan& plan, std::size_t k) const {
    const bool says_unit = !plan.unit.empty() || !plan.foreign.empty();
    const auto unit = unit_of(plan.unit);
    const double scale = plan.foreign == "ns" ? 1e-9 : unit ? unit->to_si(1.0) : 1.0;
    const double largest = contents_[k].largest;
    const bool counts = says_unit ? (contents_[k].numeric() ? !may_be_epoch(largest * scale)
                                                            : is_number((*cells_)[0][k]))
                                  : contents_[k].numeric() && !may_be_date(largest);
    if (counts) {
      plan.name = "t";
      plan.lacks_unit = !says_unit;
    } else {
      plan.unit.clear();
      plan.foreign.clear();
    }
  }

  /// Seconds in one column and the nanoseconds beyond them in another are one time stamp.
  void join_seconds(std::vector<ColumnPlan>& plans) {
    for (std::size_t k = 0; k < plans.size(); ++k) {
      const std::string stem =
          stem_of(plans[k].from, {"nanoseconds", "nanosecs", "nanosec", "nsecs", "nsec"});
      if (stem.empty() || plans[k].wished || !contents_[k].numeric() || contents_[k].largest >= 1e9)
        continue;
      for (std::size_t other = 0; other < plans.size(); ++other) {
        const std::string own = stem_of(plans[other].from, {"seconds", "secs", "sec"});
        if (other == k || own != stem || plans[other].wished || !contents_[other].numeric())
          continue;
        add_seconds(plans[other], other, plans[k], k);
        return;
      }
    }
  }

  /// "+" and what stands before one of the words, as `folded` returns it; empty if none ends it.
  static std::string stem_of(const std::string& from, std::initializer_list<const char*> words) {
    const std::string text = folded(from);
    for (const std::string word : words)
      if (text.ends_with(word)) return "+" + text.substr(0, text.size() - word.size());
    return {};
  }

  void add_seconds(ColumnPlan& whole, std::size_t k, ColumnPlan& parts, std::size_t n) {
    const char decimal = rows_.dialect.decimal;
    ImportedColumn column{whole.from, "t", "s", {}};
    double first = 0.0, first_part = 0.0;
    for (std::size_t i = 0; i < cells_->size(); ++i) {
      const CellRow row = (*cells_)[i];
      const auto seconds = number_in(row[k], decimal);
      const auto nanoseconds = number_in(row[n], decimal);
      if (!seconds) bad_number(whole, i, row[k]);
      if (!nanoseconds) bad_number(parts, i, row[n]);
      if (!seconds || !nanoseconds) continue;
      if (i == 0) first = *seconds, first_part = *nanoseconds;
      column.text.add(in_microseconds((*seconds - first) + (*nanoseconds - first_part) * 1e-9));
    }
    out_.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-IMPORT-TIME",
         .message = fmt::format("'{}' and '{}' are one time stamp, seconds and the nanoseconds "
                                "beyond them: seconds from the first",
                                whole.from, parts.from),
         .help = "to leave them out: " + map_option({whole.from + "=-", parts.from + "=-"})});
    if (may_be_epoch(first)) out_.start_s = first + first_part * 1e-9, out_.start = "date";
    out_.columns.push_back(std::move(column));
    used_.insert(used_.end(), {k, n});
    for (auto* plan : {&whole, &parts}) {
      plan->name.clear();
      plan->lacks_unit = false;
      plan->foreign.clear();
    }
  }

  static std::string in_microseconds(double seconds) {
    std::string out = fmt::format("{:.6f}", seconds);
    out.erase(out.find_last_not_of('0') + 1);
    if (out.ends_with('.')) out.pop_back();
    return out;
  }

  /// A recognised column must state a unit that plumb knows; a preview only warns.
  void look_at_units(std::vector<ColumnPlan>& plans) {
    for (std::size_t k = 0; k < plans.size(); ++k)
      if (plans[k].name == "time" && !joined_date_) look_at_time(plans[k], k);
    const UnitQuestions questions(text_, rows_.dialect, contents_, wishes_.preview);
    std::vector<std::size_t> unitless;
    for (std::size_t k = 0; k < plans.size(); ++k) {
      if (plans[k].lacks_unit) unitless.push_back(k);
      if (!plans[k].foreign.empty()) complain(questions.of_another_unit(plans[k]));
    }
    if (!unitless.empty()) complain(questions.without_unit(plans, unitless));
    for (auto& plan : plans)
      if (plan.lacks_unit || !plan.foreign.empty()) plan.unit = "?";
  }

  void complain(const Problem& problem) {
    if (wishes_.preview)
      out_.remarks.push_back(problem);
    else
      problems_.add(problem);
  }

  void add_texts(const ColumnPlan& plan, std::size_t k) {
    out_.columns.push_back({plan.from, plan.name, "", {cells_, k}});
  }

  void add_numbers(const ColumnPlan& plan, std::size_t k) {
    const char decimal = rows_.dialect.decimal;
    for (std::size_t i = 0; i < cells_->size(); ++i) {
      const auto cell = (*cells_)[i][k];
      const bool number = number_in(cell, decimal).has_value();
      if (!number) bad_number(plan, i, cell);
      if (!number || !thousands_.empty() || !divides_thousands(cell, decimal)) continue;
      if (const std::string text = as_written(plan, cell); text != cell)
        thousands_ = fmt::format("'{}' is {}", cell, text);
    }
    out_.columns.push_back({plan.from, plan.name, plan.unit, {cells_, k}});
  }

  /// A number as measurements.csv holds it.
  std::string as_written(const ColumnPlan& plan, std::string_view cell) const {
    const char decimal = rows_.dialect.decimal;
    if (plan.divisor != 1.0)
      return fmt::format("{}", number_in(cell, decimal).value_or(0.0) / plan.divisor);
    return plain_number(cell, decimal).value_or("");
  }

  /// Writes the cells of the column as measurements.csv holds them, most of which are so already.
  /// To be called when no message shows a line of the file any more.
  void write_plainly(const ColumnPlan& plan, std::size_t k) {
    const bool kept = plan.divisor == 1.0 && rows_.dialect.decimal == '.';
    for (std::size_t i = 0; i < cells_->size(); ++i) {
      const auto cell = (*cells_)[i][k];
      if (kept && is_plain_number(cell)) continue;
      if (const std::string text = as_written(plan, cell); text != cell)
        cells_->write_over(i, k, text);
    }
  }

  /// True if the cell, a number, has more signs than a sign of its own, digits and a decimal sign.
  static bool divides_thousands(std::string_view cell, char decimal) {
    const std::string_view other = decimal == ',' ? ".' " : ",' ";
    return cell.find_first_of(other) != cell.npos || cell.find("\u2019") != cell.npos ||
           cell.find("\u00A0") != cell.npos || cell.find("\u202F") != cell.npos ||
           cell.find("\u2009") != cell.npos;
  }

  void say_of_thousands() {
    if (thousands_.empty()) return;
    out_.remarks.push_back({.severity = Severity::kNote,
                            .code = "N-IMPORT-THOUSANDS",
                            .message = fmt::format("signs divide thousands: {}", thousands_),
                            .help = "if they do not: --decimal point, or --decimal comma"});
  }

  void bad_number(const ColumnPlan& plan, std::size_t i, std::string_view cell) {
    const int line = out_.lines[i];
    const auto source = text_.lines[line - 1];
    problems_.error(
        "E-IMPORT-NUMBER", fmt::format("column '{}' holds '{}', not a number", plan.from, cell),
        Place{.file = text_.file,
              .line = line,
              .column = static_cast<int>(cell.data() - source.data()) + 1,
              .length = std::max(1, static_cast<int>(cell.size())),
              .source = std::string(source),
              .label = "not a number"},
        fmt::format("leave out the rows without a measurement: --skip-bad; or the column: --map "
                    "\"{}=-\"",
                    plan.from));
  }

  /// The cells of a time stamp, preceded by the date if that is in another column.
  CellColumn stamps(std::size_t k) const {
    if (!joined_date_) return {cells_, k};
    CellColumn out;
    for (std::size_t i = 0; i < cells_->size(); ++i)
      out.add(joined((*cells_)[i][date_column_], (*cells_)[i][k]));
    return out;
  }

  /// Spreadsheets write a date alone as "2022-10-20 00:00:00".
  static std::string joined(std::string_view date, std::string_view time) {
    for (const char* midnight : {" 00:00:00", "T00:00:00", " 00:00"})
      if (date.ends_with(midnight)) date.remove_suffix(std::string_view(midnight).size());
    return fmt::format("{} {}", date, time);
  }

  Place row_of_file(std::size_t row, std::string label) const {
    const int line = out_.lines[std::min(row, out_.lines.size() - 1)];
    return {.file = text_.file,
            .line = line,
            .column = 1,
            .source = std::string(text_.lines[line - 1]),
            .label = std::move(label)};
  }

  void add_times(const ColumnPlan& plan, std::size_t k) {
    const CellColumn texts = stamps(k);
    Timestamps times = read_timestamps(texts, rows_.dialect.decimal, wishes_.date_order);
    if (times.undecided)
      complain({.severity = wishes_.preview ? Severity::kWarning : Severity::kError,
                .code = wishes_.preview ? "W-IMPORT-TIME" : "E-IMPORT-DATE",
                .message = fmt::format("'{}': whether '{}' begins with the day or with the month "
                                       "cannot be told: no number of the file is beyond 12",
                                       plan.from, texts.front()),
                .place = row_of_file(0, times.format),
                .help = "--date day-first, or --date month-first"});
    if (times.seconds.empty()) {
      if (!times.undecided)
        out_.remarks.push_back({.severity = Severity::kWarning,
                                .code = "W-IMPORT-TIME",
                                .message = fmt::format("the time stamps in '{}' are lost: {}",
                                                       plan.from, times.damage),
                                .place = row_of_file(times.damaged_row, "from here on"),
                                .help = "export again without opening the file in a spreadsheet"});
      out_.left_out.push_back(plan.from);
      return;
    }
    out_.columns.push_back({plan.from, "t", "s", {cells_, k}});
    out_.start_s = times.first;
    out_.start = times.format == "clock" ? "clock" : "date";
    if (times.format != "ISO 8601" && times.format != "clock" && times.format != "YYYYMMDDhhmmss")
      out_.remarks.push_back(
          {.severity = Severity::kNote,
           .code = "N-IMPORT-TIME",
           .message = fmt::format("the time stamps in '{}' were read as {}: "
                                  "seconds from the first, {:g} in all",
                                  plan.from, times.format,
                                  *std::max_element(times.seconds.begin(), times.seconds.end())),
           .help =
               fmt::format("to leave them out: {}", map_option({rows_.dialect.header[k] + "=-"}))});
    if (times.wrapped)
      out_.remarks.push_back(
          {.severity = Severity::kNote,
           .code = "N-IMPORT-MIDNIGHT",
           .message = fmt::format("the clock in '{}' passed midnight", plan.from),
           .help = "a day was added"});
    time_column_ = k;
    times_ = std::move(times);
  }

  void write_times() {
    const bool epoch = times_.format.ends_with("since 1970");
    for (std::size_t i = 0; i < times_.seconds.size(); ++i) {
      const double t = times_.seconds[i];
      cells_->write_over(i, time_column_,
                         epoch     ? in_microseconds(t)
                         : t > 1e5 ? fmt::format("{:.3f}", t)
                                   : fmt::format("{:.6g}", t));
    }
  }

  void say_what_was_left_out() {
    if (out_.left_out.empty()) return;
    out_.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-IMPORT-LEFT",
         .message = fmt::format("columns left out: {}", fmt::join(out_.left_out, ", ")),
         .help = fmt::format("to keep one: {}", map_option({out_.left_out.front() + kept_as_}))});
  }

  const SourceText& text_;
  RawRows rows_;
  std::shared_ptr<CellTable> cells_;  // those of `rows_`, and of the columns
  const ImportWishes& wishes_;
  std::vector<ColumnContent> contents_;
  std::size_t date_column_ = 0, time_column_ = 0;
  Timestamps times_;
  bool joined_date_ = false;
  std::vector<std::size_t> used_;  // columns that became part of another
  std::optional<PoseMatrix> matrix_;
  std::string kept_as_ = "=NAME_UNIT";  // how the first column that is left out could be kept
  std::string thousands_;               // the first number of which signs divide the thousands
  ProblemList problems_;
  Imported out_;
};

}  // namespace

Imported import_file(const std::filesystem::path& file, const ImportWishes& wishes) {
  SourceText text;
  decode(read_file(file), display_name(file), text);
  RawRows rows = cut(text, wishes.dialect);
  refuse_transposed(text, rows);
  return Importer(text, std::move(rows), wishes).run();
}

std::vector<std::string> column_names(const std::filesystem::path& file,
                                      const DialectWishes& wishes) {
  SourceText text;
  decode(read_file(file), display_name(file), text);
  return cut(text, wishes).dialect.header;
}

}  // namespace plumb::offline
