// SPDX-License-Identifier: Apache-2.0
#include "import/importer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "cell/column_names.hpp"
#include "cell/units.hpp"
#include "import/cells.hpp"
#include "import/column_guess.hpp"
#include "import/content.hpp"
#include "import/euler.hpp"
#include "import/heading.hpp"
#include "import/map_option.hpp"
#include "import/number_text.hpp"
#include "import/pose_matrix.hpp"
#include "import/timestamps.hpp"
#include "import/transposed.hpp"
#include "import/words.hpp"
#include "program/file.hpp"
#include "program/problem_list.hpp"

namespace plumb::offline {
namespace {

constexpr double kOneTurn = 6.3;      // [rad], rounded up
constexpr double kLeastMove_m = 0.2;  // of the points: a few degrees may cause less
constexpr double kLongLever_m = 1.0;  // lever arm at which all joints move the tool one way
constexpr int kRowsToJudge = 8;
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
    take_matrix(plans);
    take_stated_units(plans);
    look_at_units(plans);
    say_of_uncertainties(plans);
    say_of_sliding(plans);
    const auto orientation = matrix_ ? orientation_of(*matrix_) : std::vector<ImportedColumn>{};
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
    say_of_radians(plans);
    turn_to_quaternions();
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

  /// A homogeneous matrix in every row is a position and an orientation.
  void take_matrix(std::vector<ColumnPlan>& plans) {
    const auto is_taken = [&](const char* name) {
      return std::any_of(plans.begin(), plans.end(),
                         [&](const ColumnPlan& plan) { return plan.name == name; });
    };
    if (is_taken("x") || is_taken("y") || is_taken("z")) return;
    matrix_ = matrix_in(plans, contents_);
    if (!matrix_) return;
    for (int i = 0; i < 3; ++i) {
      ColumnPlan& plan = plans[matrix_->at[i][3]];
      const WrittenHeading heading = read_heading(plan.from);
      plan.name = std::string(1, "xyz"[i]);
      plan.unit = heading.unit;
      plan.foreign = heading.foreign;
      plan.lacks_unit = plan.unit.empty() && plan.foreign.empty();
      for (int k = 0; k < 3; ++k) used_.push_back(matrix_->at[i][k]);
    }
    used_.insert(used_.end(), matrix_->last_row.begin(), matrix_->last_row.end());
    out_.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-IMPORT-MATRIX",
         .message = fmt::format("{} to {} are a position and an orientation, as a matrix: taken as "
                                "those measured",
                                plans[matrix_->at[0][0]].from, plans[matrix_->at[2][3]].from),
         .help = "if the controller computed them, name the position nx, ny, nz with --map"});
    if (is_taken("qw")) matrix_.reset();
  }

  std::vector<ImportedColumn> orientation_of(const PoseMatrix& matrix) const {
    const char decimal = rows_.dialect.decimal;
    std::vector<ImportedColumn> quat;
    for (const char* name : {"qw", "qx", "qy", "qz"}) quat.push_back({"", name, "", {}});
    for (std::size_t row = 0; row < cells_->size(); ++row) {
      std::array<double, 9> r{};
      for (int i = 0; i < 9; ++i)
        r[i] = number_in((*cells_)[row][matrix.at[i / 3][i % 3]], decimal).value_or(NAN);
      const auto q = quaternion_of(r);
      for (std::size_t k = 0; k < 4; ++k) quat[k].text.add(fmt::format("{:.9g}", q[k]));
    }
    return quat;
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

  /// Columns that say no unit have the one that a line above the table states.
  void take_stated_units(std::vector<ColumnPlan>& plans) {
    std::vector<std::string> lengths, angles;
    for (auto& plan : plans) {
      if (!plan.lacks_unit) continue;
      const auto allowed = allowed_quantities(plan.name);
      const StatedUnits& stated = rows_.stated;
      const bool angle = allowed.front() == Quantity::kAngle;
      const bool length = allowed.front() == Quantity::kLength;
      const std::string unit = angle ? stated.angle : length ? stated.length : "";
      if (unit.empty()) continue;
      plan.unit = unit;
      plan.lacks_unit = false;
      (angle ? angles : lengths).push_back(plan.from);
    }
    const auto say = [&](const std::vector<std::string>& columns, const std::string& unit,
                         int line) {
      if (columns.empty()) return;
      out_.remarks.push_back(
          {.severity = Severity::kNote,
           .code = "N-IMPORT-STATED",
           .message = fmt::format("{}: in {}, as line {} says", in_short(columns), unit, line),
           .place = Place{.file = text_.file, .line = line},
           .help = "--map says otherwise"});
    };
    say(angles, rows_.stated.angle, rows_.stated.angle_line);
    say(lengths, rows_.stated.length, rows_.stated.length_line);
  }

  /// A recognised column must state a unit that plumb knows; a preview only warns.
  void look_at_units(std::vector<ColumnPlan>& plans) {
    for (std::size_t k = 0; k < plans.size(); ++k)
      if (plans[k].name == "time" && !joined_date_) look_at_time(plans[k], k);
    std::vector<std::size_t> unitless;
    for (std::size_t k = 0; k < plans.size(); ++k) {
      if (plans[k].lacks_unit) unitless.push_back(k);
      if (!plans[k].foreign.empty()) complain(of_another_unit(plans[k]));
    }
    if (!unitless.empty()) complain(without_unit(plans, unitless));
    for (auto& plan : plans)
      if (plan.lacks_unit || !plan.foreign.empty()) plan.unit = "?";
  }

  void complain(const Problem& problem) {
    if (wishes_.preview)
      out_.remarks.push_back(problem);
    else
      problems_.add(problem);
  }

  /// Columns of one kind have one unit: q1 to q6, x to z.
  static std::string kind_of(const std::string& name) {
    if (joint_number(name, "q") > 0) return "q";
    if (joint_number(name, "qc") > 0) return "qc";
    if (joint_number(name, "travel_j") > 0) return "travel";
    const bool axis = !name.empty() && name.back() >= 'x' && name.back() <= 'z';
    return axis ? name.substr(0, name.size() - 1) + "x" : name;
  }

  /// What to offer for the columns of one kind, and why.
  UnitChoice choice_for(const std::vector<ColumnPlan>& plans, std::size_t k) const {
    const std::string kind = kind_of(plans[k].name);
    double largest = 0.0;
    for (std::size_t i = 0; i < plans.size(); ++i) {
      if (plans[i].name.empty() || kind_of(plans[i].name) != kind) continue;
      if (plans[i].lacks_unit)
        largest = std::max(largest, contents_[i].largest);
      else if (plans[i].foreign.empty() && kind != plans[i].name)
        return {{plans[i].unit}, fmt::format("{}, like '{}'", plans[i].unit, plans[i].from)};
    }
    return unit_choice(plans[k].name, largest);
  }

  /// One sentence and one line to paste for all columns that do not say their unit.
  Problem without_unit(const std::vector<ColumnPlan>& plans,
                       const std::vector<std::size_t>& unitless) const {
    std::vector<std::pair<std::string, std::vector<std::string>>> kinds;  // reason -> columns
    std::vector<std::string> names, wishes;
    bool choose = false;
    for (const std::size_t k : unitless) {
      const UnitChoice choice = choice_for(plans, k);
      choose = choose || choice.units.size() > 1;
      names.push_back(plans[k].from);
      wishes.push_back(fmt::format("{}={}_{}", plans[k].from, map_name(plans[k]), choice.text()));
      if (kinds.empty() || kinds.back().first != choice.reason)
        kinds.push_back({choice.reason, {}});
      kinds.back().second.push_back(plans[k].from);
    }
    std::vector<std::string> reasons;
    for (const auto& [reason, columns] : kinds)
      reasons.push_back(fmt::format("{} ({})", in_short(columns), reason));
    const ColumnPlan& first = plans[unitless.front()];
    Problem out =
        of_unit(first,
                unitless.size() == 1
                    ? fmt::format("column '{}' has no unit", first.from)
                    : fmt::format("{} columns have no unit: {}", unitless.size(), in_short(names)),
                unitless.size() == 1 ? fmt::format("taken as '{}'; {}", first.name,
                                                   choice_for(plans, unitless.front()).reason)
                                     : fmt::format("{}", fmt::join(reasons, "; ")),
                map_option(wishes));
    if (choose) out.help += "  (keep one of the units that | divides)";
    return out;
  }

  /// The name of the column in a proposed --map. An expanded uncertainty is named as one, so that
  /// pasting the proposal changes no number.
  static std::string map_name(const ColumnPlan& plan) {
    return plan.divisor != 1.0 ? "u95" + plan.name.substr(1) : plan.name;
  }

  static std::string in_short(const std::vector<std::string>& names) {
    if (names.size() <= 4) return fmt::format("{}", fmt::join(names, ", "));
    return fmt::format("{}, {}, ... {}", names[0], names[1], names.back());
  }

  Problem of_another_unit(const ColumnPlan& plan) const {
    const ForeignUnit& unit = *foreign_unit(plan.foreign);
    return of_unit(plan,
                   fmt::format("column '{}' is in {}, which is none of plumb's units", plan.from,
                               plan.foreign),
                   std::string(unit.equals),
                   fmt::format("convert the numbers and name the column {}_{}, or leave it out: {}",
                               plan.name, unit.use, map_option({plan.from + "=-"})));
  }

  /// Reports the uncertainties that were divided to make them one standard deviation, and those
  /// that were left out because the divisor or the axis is not known.
  void say_of_uncertainties(const std::vector<ColumnPlan>& plans) {
    std::vector<std::string> divided, as_they_are, unclear, wishes;
    bool unit_known = false;
    std::string said;
    double divisor = 1.0;
    for (const auto& plan : plans) {
      if (plan.divisor != 1.0) {
        divided.push_back(plan.from), said = plan.said, divisor = plan.divisor;
        as_they_are.push_back(fmt::format("{}={}_{}", plan.from, plan.name, unit_in_wish(plan)));
      }
      if (!plan.named.uncertain || plan.wished) continue;
      unclear.push_back(plan.from);
      if (wishes.empty()) unit_known = !plan.uncertain_unit.empty();
      wishes.push_back(plan.uncertain_unit.empty() ? "um" : plan.uncertain_unit);
    }
    if (!divided.empty())
      out_.remarks.push_back(
          {.severity = Severity::kNote,
           .code = "N-IMPORT-EXPANDED",
           .message = fmt::format("{} hold expanded uncertainties ({}): divided by {:g} they are "
                                  "one standard deviation",
                                  in_short(divided), said, divisor),
           .help = "if they already are one: " + map_option(as_they_are)});
    if (!unclear.empty())
      out_.remarks.push_back(
          {.severity = Severity::kWarning,
           .code = "W-IMPORT-UNCERTAINTY",
           .message =
               fmt::format("{} left out: nothing says of which axis, or of how many standard "
                           "deviations, these uncertainties are",
                           in_short(unclear)),
           .help =
               fmt::format("{} if one, or u95x_{} if two (k = 2, 95 %){}",
                           map_option({unclear.front() + "=sx_" + wishes.front()}), wishes.front(),
                           unit_known ? "" : "; mm in place of um if that is the unit")});
  }

  /// Millimetres are right for a sliding joint only. Whether the joint slides is known to the cell
  /// file alone, so this is a note.
  void say_of_sliding(const std::vector<ColumnPlan>& plans) {
    for (const auto& plan : plans) {
      const auto unit = unit_of(plan.unit);
      if (!plan.wished || joint_number(plan.name, "q") == 0 || !unit ||
          unit->quantity != Quantity::kLength)
        continue;
      out_.remarks.push_back(
          {.severity = Severity::kNote,
           .code = "N-IMPORT-SLIDE",
           .message = fmt::format("{} is taken in {}: that is right for a sliding joint only",
                                  plan.name, plan.unit),
           .help = "if it turns: " + map_option({fmt::format("{}={}_deg", plan.from, plan.name)})});
    }
  }

  /// Largest minus smallest number of a column, in SI; 0 if it is not there.
  double span_of(const std::string& name) const {
    const ImportedColumn* column = out_.find(name);
    if (column == nullptr || column->text.empty() || !unit_of(column->unit)) return 0.0;
    double low = value_of(*column, 0), high = low;
    for (std::size_t i = 1; i < column->text.size(); ++i) {
      low = std::min(low, value_of(*column, i));
      high = std::max(high, value_of(*column, i));
    }
    return high - low;
  }

  /// Warns of joint columns in degrees that probably hold radians: no number is larger than one
  /// turn in radians, and the points moved much farther than such small angles could move them.
  /// Nothing is converted.
  void say_of_radians(const std::vector<ColumnPlan>& plans) {
    std::vector<std::string> names, wishes;
    double largest = 0.0, turned = 0.0;
    for (std::size_t k = 0; k < plans.size(); ++k) {
      if (joint_number(plans[k].name, "q") == 0 || plans[k].unit != "deg" || plans[k].wished)
        continue;
      names.push_back(plans[k].from);
      wishes.push_back(fmt::format("{}={}_rad", plans[k].from, plans[k].name));
      largest = std::max(largest, contents_[k].largest);
      turned += span_of(plans[k].name);
    }
    const double moved = std::hypot(span_of("x"), span_of("y"), span_of("z"));
    if (names.empty() || out_.rows() < kRowsToJudge || largest > kOneTurn || moved < kLeastMove_m ||
        moved < turned * kLongLever_m)
      return;
    out_.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-IMPORT-RADIANS",
         .message = fmt::format("{} say deg, but no number is beyond {:.3g}: all joints together "
                                "turn by {:.2g} deg and the points move by {:.2g} m, which fits "
                                "radians",
                                in_short(names), largest, turned * 180.0 / M_PI, moved),
         .help = "if they are radians: " + map_option(wishes)});
  }

  /// The unit of the column, or the usual one of uncertainties.
  static std::string unit_in_wish(const ColumnPlan& plan) {
    return plan.unit.empty() || plan.unit == "?" ? "um" : plan.unit;
  }

  /// The position of a name as a whole word: 'x' is not found at the end of "index".
  static std::size_t place_of(const std::string& line, const std::string& name) {
    const auto part_of_word = [&](std::size_t at) {
      return at < line.size() && std::isalnum(static_cast<unsigned char>(line[at])) != 0;
    };
    for (auto at = line.find(name); at != line.npos; at = line.find(name, at + 1))
      if ((at == 0 || !part_of_word(at - 1)) && !part_of_word(at + name.size())) return at;
    return line.find(name);
  }

  Problem of_unit(const ColumnPlan& plan, std::string message, std::string label,
                  std::string help) const {
    const int line = std::max(rows_.dialect.header_line, 1);
    const std::string source(text_.lines[line - 1]);
    const auto column = std::min(place_of(source, plan.from), source.size());
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

  static double value_of(const ImportedColumn& column, std::size_t i) {
    double value = 0.0;
    const auto text = column.text[i];
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
      for (std::size_t i = 0; i < cells_->size(); ++i) {
        const auto q = quaternion(
            convention, {value_of(*turns[0], i), value_of(*turns[1], i), value_of(*turns[2], i)});
        for (std::size_t k = 0; k < 4; ++k) quat[k].text.add(fmt::format("{:.12g}", q[k]));
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
