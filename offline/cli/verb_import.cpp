// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/cell_data.hpp"
#include "cli/progress.hpp"
#include "cli/verbs.hpp"
#include "import/importer.hpp"
#include "import/joining.hpp"
#include "program/file.hpp"
#include "program/output_files.hpp"
#include "show/text_table.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> files, map, header;
  std::string output, separator, decimal, rotation, join, direction;
  double max_gap_s = 1.0;
  bool preview = false;
  WriteOptions write;
};

[[noreturn]] void usage(std::string message, std::string help) {
  throw Failure(Exit::kUsage,
                {.code = "E-USAGE", .message = std::move(message), .help = std::move(help)});
}

std::optional<char> separator_of(const std::string& word) {
  if (word.empty()) return std::nullopt;
  static const std::map<std::string, char> kWords{
      {"comma", ','}, {"semicolon", ';'}, {"tab", '\t'}, {"bar", '|'}, {"blanks", ' '}};
  if (const auto at = kWords.find(word); at != kWords.end()) return at->second;
  if (word.size() == 1) return word.front();
  usage(fmt::format("--separator: '{}' is none", word),
        "comma, semicolon, tab, bar, blanks, or one character");
}

std::optional<char> decimal_of(const std::string& word) {
  if (word.empty()) return std::nullopt;
  if (word == "comma" || word == ",") return ',';
  if (word == "point" || word == ".") return '.';
  usage(fmt::format("--decimal: '{}' is neither comma nor point", word), "--decimal comma");
}

JoinBy join_of(const std::string& word) {
  if (word.empty() || word == "pose") return JoinBy::kPose;
  if (word == "time") return JoinBy::kTime;
  if (word == "order") return JoinBy::kOrder;
  usage(fmt::format("--join: '{}' is none of pose, time, order", word), "--join order");
}

/// The nearest cell, if there is a sound one: its arm tells a shift.
std::optional<Cell> nearest_cell(const Globals& globals) {
  try {
    return read_cell(
        find_cell(globals.directory.empty() ? fs::current_path() : fs::path(globals.directory)));
  } catch (const Failure&) {
    if (!globals.directory.empty()) throw;
    return std::nullopt;
  }
}

Imported import_all(const Options& options, const std::optional<Cell>& cell) {
  if (options.files.size() > 2)
    usage("import takes one file, or two that belong together", "import them one after the other");
  const ImportWishes wishes{.dialect = {.separator = separator_of(options.separator),
                                        .decimal = decimal_of(options.decimal),
                                        .header = options.header},
                            .map = options.map,
                            .rotation = options.rotation,
                            .preview = options.preview};
  if (!options.direction.empty() && options.direction != "from-order")
    usage(fmt::format("--dir: '{}' is not known", options.direction), "--dir from-order");
  Imported data = import_file(options.files[0], wishes);
  if (options.files.size() == 2)
    data = join(data, import_file(options.files[1], wishes),
                {.by = join_of(options.join),
                 .max_gap_s = options.max_gap_s,
                 .cell = cell ? &*cell : nullptr});
  if (options.direction == "from-order") add_directions(data);
  return data;
}

std::string column_table(const Imported& data) {
  show::TextTable table({"column", "becomes", "first", "last"});
  for (const auto& column : data.columns)
    table.add({column.from.empty() ? "(derived)" : column.from, column.heading(),
               column.text.front(), column.text.back()});
  return table.text();
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

fs::path target_of(const Options& options, const std::optional<Cell>& cell) {
  if (!options.output.empty()) return options.output;
  if (cell) return cell->directory / "measurements.csv";
  return "measurements.csv";
}

void import(const Options& options, const Globals& globals, Outcome& outcome) {
  const Progress progress("importing");
  const std::optional<Cell> cell = nearest_cell(globals);
  const Imported data = import_all(options, cell);
  for (const auto& file : options.files)
    outcome.inputs.push_back({display_name(file), sha256(read_file(file))});
  outcome.remark(data.remarks);
  const fs::path target = target_of(options, cell);
  outcome.result = {{"rows", data.rows()},
                    {"separator", data.separator},
                    {"decimal", data.decimal},
                    {"columns", columns_json(data)},
                    {"left_out", data.left_out}};
  outcome.text = fmt::format("Understood {} rows; separated by {}, decimal {}.\n\n{}", data.rows(),
                             data.separator, data.decimal, column_table(data));
  if (options.preview) {
    outcome.result["files"] = Json::array();
    outcome.text += "\npreview: nothing was written\n";
    return;
  }
  const std::string csv = imported_csv(data);
  (void)parse_table(csv, "imported");  // what we write, we read
  OutputFiles files;
  files.add(target, csv);
  files.commit(options.write, outcome);
  outcome.text += fmt::format("\n{}\nNext: plumb check\n", wrote(target, options.write));
}

}  // namespace

void add_import(Program& program) {
  const auto options = std::make_shared<Options>();
  CLI::App& verb = program.verb(
      {.name = "import",
       .summary = "Turn a tracker's or controller's text file into measurements.csv",
       .examples = "  plumb import tracker.txt --preview\n"
                   "  plumb import log.csv --map \"Goal x=nx_m\" --map x=x_mm -o measurements.csv"},
      [options](const Globals& g, Outcome& o) { import(*options, g, o); });
  verb.add_option("files", options->files, "One file, or two that belong together")
      ->required()
      ->type_name("FILE");
  verb.add_option("-o,--output", options->output,
                  "Where to write; measurements.csv of the nearest cell")
      ->type_name("FILE");
  verb.add_option("--map", options->map, "What a column is: OLD=NEW_UNIT, or OLD=- to leave it out")
      ->type_name("OLD=NEW,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--header", options->header, "Names of the columns, if the file has none")
      ->type_name("A,B,...")
      ->delimiter(',');
  verb.add_option("--separator", options->separator,
                  "comma, semicolon, tab, bar, blanks; else detected")
      ->type_name("WORD");
  verb.add_option("--decimal", options->decimal, "comma or point; else detected")
      ->type_name("WORD");
  verb.add_option("--rot", options->rotation,
                  "What rx, ry, rz mean: xyz-fixed (R = Rz Ry Rx), xyz-moving (R = Rx Ry Rz), ...")
      ->type_name("ORDER");
  verb.add_option("--join", options->join, "How two files belong together: pose, time, order")
      ->type_name("BY");
  verb.add_option("--max-gap", options->max_gap_s, "--join time: farther apart is no partner [s]")
      ->type_name("S");
  verb.add_option("--dir", options->direction,
                  "from-order: the rows are consecutive moves; adds dir_jN and travel_jN")
      ->type_name("HOW");
  verb.add_flag("--preview", options->preview, "Show what was understood and write nothing");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
