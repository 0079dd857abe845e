// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cell/setups.hpp"
#include "cli/cell_data.hpp"
#include "cli/csv_output.hpp"
#include "cli/next_line.hpp"
#include "cli/progress.hpp"
#include "cli/verbs.hpp"
#include "import/completeness.hpp"
#include "import/directions.hpp"
#include "import/euler.hpp"

#include "import/imported_csv.hpp"
#include "import/importer.hpp"
#include "import/joining.hpp"
#include "program/counted_words.hpp"
#include "program/file.hpp"
#include "program/output_files.hpp"
#include "program/spool.hpp"
#include "show/table.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualGap_s = 1.0;  // between rows that are joined by time; chosen

struct ImportArguments {
  std::vector<std::string> files, map, header;
  std::string output, separator, decimal, rotation, join, direction, date;
  std::optional<double> max_gap_s;
  bool skip_bad = false, preview = false;
  WriteOptions write;
};

[[noreturn]] void import_usage(std::string message, std::string help) {
  throw Failure(Exit::kUsage,
                {.code = "E-USAGE", .message = std::move(message), .help = std::move(help)});
}

std::optional<char> separator_of(const std::string& word) {
  if (word.empty()) return std::nullopt;
  static const std::map<std::string, char> kWords{
      {"comma", ','}, {"semicolon", ';'}, {"tab", '\t'}, {"bar", '|'}, {"blanks", ' '}};
  if (const auto at = kWords.find(word); at != kWords.end()) return at->second;
  if (word.size() == 1) return word.front();
  import_usage(fmt::format("--separator: '{}' is not a separator", word),
               "comma, semicolon, tab, bar, blanks, or one character");
}

std::optional<char> decimal_of(const std::string& word) {
  if (word.empty()) return std::nullopt;
  if (word == "comma" || word == ",") return ',';
  if (word == "point" || word == ".") return '.';
  import_usage(fmt::format("--decimal: '{}' is neither comma nor point", word), "--decimal comma");
}

DateOrder date_of(const std::string& word) {
  if (word.empty()) return DateOrder::kUnknown;
  if (word == "day-first") return DateOrder::kDayFirst;
  if (word == "month-first") return DateOrder::kMonthFirst;
  import_usage(fmt::format("--date: '{}' is neither day-first nor month-first", word),
               "--date day-first");
}

JoinBy join_of(const std::string& word) {
  if (word.empty() || word == "pose") return JoinBy::kPose;
  if (word == "time") return JoinBy::kTime;
  if (word == "order") return JoinBy::kOrder;
  import_usage(fmt::format("--join: '{}' is none of pose, time, order", word), "--join order");
}

/// The nearest cell, if there is a valid one: by its arm a shift of rows between two files is
/// found.
std::optional<Cell> nearest_cell(const Globals& globals) {
  try {
    return read_cell(
        find_cell(globals.directory.empty() ? fs::current_path() : fs::path(globals.directory)));
  } catch (const Failure&) {
    if (!globals.directory.empty()) throw;
    return std::nullopt;
  }
}

Imported import_all(const ImportArguments& options, const std::optional<Cell>& cell) {
  if (options.files.size() > 2)
    import_usage("import takes one file, or two that belong together",
                 "import them one after the other");
  if (!options.rotation.empty()) (void)euler_convention(options.rotation);
  const JoinBy by = join_of(options.join);
  if (options.files.size() == 1 && !options.join.empty())
    import_usage("--join lays two files side by side, and one is given",
                 "plumb import controller.csv tracker.csv --join " + options.join);
  if (by != JoinBy::kTime && options.max_gap_s)
    import_usage("--max-gap is the time between partners of --join time", "add --join time");
  ImportWishes wishes{.dialect = {.separator = separator_of(options.separator),
                                  .decimal = decimal_of(options.decimal),
                                  .header = options.header},
                      .map = options.map,
                      .rotation = options.rotation,
                      .date_order = date_of(options.date),
                      .skip_bad = options.skip_bad,
                      .preview = options.preview,
                      .elsewhere = {},
                      .joints = {}};
  if (cell)
    for (const auto& joint : cell->nominal.joints) wishes.joints.push_back(joint.name);
  const auto other = [&](std::size_t file) {
    return options.files.size() == 2 && !options.map.empty()
               ? column_names(options.files[1 - file], wishes.dialect)
               : std::vector<std::string>{};
  };
  if (!options.direction.empty() && options.direction != "from-order")
    import_usage(fmt::format("--dir: '{}' is not known", options.direction), "--dir from-order");
  if (options.skip_bad && !options.direction.empty())
    import_usage("--dir from-order takes every row for a move, and --skip-bad leaves rows out",
                 "mark the rows instead: column set = ignore");
  wishes.elsewhere = other(0);
  Imported data = import_file(options.files[0], wishes);
  if (options.files.size() == 2) {
    wishes.elsewhere = other(1);
    data = join(data, import_file(options.files[1], wishes),
                {.by = by,
                 .max_gap_s = options.max_gap_s.value_or(kUsualGap_s),
                 .cell = cell ? &*cell : nullptr});
  }
  if (options.direction == "from-order") add_directions(data);
  return data;
}

std::string column_table(const Imported& data) {
  show::Table table{.head = {"column", "becomes", "first", "last"}};
  for (const auto& column : data.columns)
    table.add({column.from.empty() ? "(derived)" : column.from, column.heading(),
               std::string(column.text.front()), std::string(column.text.back())});
  return show::text_of(table);
}

Json columns_json(const Imported& data) {
  Json out = Json::array();
  for (const auto& column : data.columns)
    out.push_back({{"from", column.from},
                   {"to", column.heading()},
                   {"first", column.text.front()},
                   {"last", column.text.back()}});
  return out;
}

fs::path target_of(const ImportArguments& options, const std::optional<Cell>& cell) {
  if (!options.output.empty()) return options.output;
  if (cell) return cell->directory / "measurements.csv";
  return "measurements.csv";
}

bool reads(const Cell& cell, const fs::path& target) {
  const auto files = measurement_files(cell.measurement);
  return std::any_of(files.begin(), files.end(), [&](const fs::path& file) {
    return fs::weakly_canonical(file) == fs::weakly_canonical(target);
  });
}

/// Measurements cost a day of work: the message that proposes --force also says what would be lost.
void keep_what_is_measured(const ImportArguments& options, const std::optional<Cell>& cell,
                           const fs::path& target) {
  if (options.write.force || !cell || !fs::exists(target) || !reads(*cell, target)) return;
  throw Failure(
      Exit::kUsage,
      {.code = "E-EXISTS",
       .message = fmt::format("{} is already there: it holds the measurements of this cell",
                              target.string()),
       .help = "to keep them, write to another file with -o, and name both in files of "
               "[measurement]; --force replaces them"});
}

/// A file that the cell does not read is of no use before cell.toml names it.
void say_after(const fs::path& target, const std::optional<Cell>& cell, const Globals& globals,
               Outcome& outcome) {
  if (cell && !reads(*cell, target))
    outcome.text +=
        fmt::format("{} does not read this file yet: add \"{}\" to files in [measurement].\n",
                    display_name(cell->file), fs::proximate(target, cell->directory).string());
  say_next(globals, "check", outcome);
}

void write(const Imported& data, const CsvOutput& output, Outcome& outcome) {
  refuse_existing(output, outcome);
  Spool spool(output.file);
  if (!output.write.dry_run)
    write_imported(data, [&](std::string_view rows) { spool.write(rows); });
  deliver(spool, output, outcome);
}

void import(const ImportArguments& options, const Globals& globals, Outcome& outcome) {
  const Progress progress("importing");
  const std::optional<Cell> cell = nearest_cell(globals);
  const Imported data = import_all(options, cell);
  outcome.inputs.insert(outcome.inputs.end(), data.inputs.begin(), data.inputs.end());
  outcome.remark(data.remarks);
  std::optional<Problem> missing = missing_for_calibration(data, cell ? cell->joints() : 0);
  if (missing && !options.preview) throw Failure(Exit::kInput, *missing);
  if (missing) {
    missing->severity = Severity::kWarning;
    missing->code = "W-IMPORT-MISSING";
    outcome.remark({*missing});
  }
  if (cell) keep_files(*cell, Makes::kMeasurements, outcome);
  const fs::path target = target_of(options, cell);
  outcome.result = {{"rows", data.rows()},
                    {"separator", data.separator},
                    {"decimal", data.decimal},
                    {"columns", columns_json(data)},
                    {"left_out", data.left_out}};
  outcome.text = fmt::format("Understood {}; separated by {}, decimal {}.\n\n{}",
                             counted_words(data.rows(), "row", "rows"), data.separator,
                             data.decimal, column_table(data));
  if (options.preview) {
    outcome.result["files"] = Json::array();
    outcome.result["dry_run"] = true;
    outcome.text += "\npreview: nothing was written\n";
    return;
  }
  check_imported(data);
  keep_what_is_measured(options, cell, target);
  write(data, {.file = target.string(), .write = options.write}, outcome);
  outcome.text += "\n" + wrote(target, options.write) + "\n";
  say_after(target, cell, globals, outcome);
}

}  // namespace

void add_import(Program& program) {
  const auto options = std::make_shared<ImportArguments>();
  VerbOptions verb = program.verb(
      {.name = "import",
       .summary = "Turn a tracker's or controller's text file into measurements.csv",
       .examples = "  plumb import tracker.txt --preview\n"
                   "  plumb import log.csv --map \"Goal x=nx_m\" --map x=x_mm -o measurements.csv"},
      [options](const Globals& g, Outcome& o) { import(*options, g, o); });
  verb.add_option("files", options->files, "One file, or two that belong together")
      .required()
      .type_name("FILE");
  verb.add_option("-o,--output", options->output,
                  "Where to write; else measurements.csv of the nearest cell")
      .type_name("FILE");
  verb.add_option("--map", options->map, "What a column is: OLD=NEW_UNIT, or OLD=- to leave it out")
      .type_name("OLD=NEW,...")
      .one_value_each();
  verb.add_option("--header", options->header, "Names of the columns, if the file has none")
      .type_name("A,B,...")
      .delimiter(',');
  verb.add_option("--separator", options->separator,
                  "comma, semicolon, tab, bar, blanks; else detected")
      .type_name("WORD");
  verb.add_option("--decimal", options->decimal, "comma or point; else detected").type_name("WORD");
  verb.add_option("--rot", options->rotation,
                  "What rx, ry, rz mean: xyz-fixed (R = Rz Ry Rx), xyz-moving (R = Rx Ry Rz), ...")
      .type_name("ORDER");
  verb.add_option("--date", options->date,
                  "What 03/04/2022 begins with: day-first, month-first; else the file tells")
      .type_name("ORDER");
  verb.add_option("--join", options->join, "How two files belong together: pose, time, order")
      .type_name("BY");
  verb.add_option("--max-gap", options->max_gap_s,
                  "With --join time: rows that are farther apart are not joined [s]")
      .type_name("S")
      .check(greater_than_zero());
  verb.add_option("--dir", options->direction,
                  "from-order: the rows are consecutive moves; adds dir_jN and travel_jN")
      .type_name("HOW");
  verb.add_flag("--skip-bad", options->skip_bad,
                "Leave out rows with a cell that should be a number and is none, and list them");
  verb.add_flag("--preview", options->preview, "Show what was understood and write nothing");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
