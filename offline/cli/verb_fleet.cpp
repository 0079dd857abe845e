// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <thread>

#include "cli/next_line.hpp"
#include "cli/progress.hpp"
#include "cli/verbs.hpp"
#include "fleet/fleet.hpp"
#include "program/file.hpp"
#include "program/shell_word.hpp"
#include "report/fleet_report.hpp"
#include "show/fleet_view.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

struct FleetArguments {
  std::string folder, output, share;
  bool diagnose = false;
  int jobs = 0;  // 0: as many as there are processors
};

struct Share {
  int index = 0, of = 1;
};

/// "3/8": the fourth of eight shares.
Share share_of_text(const std::string& text) {
  Share out;
  if (text.empty()) return out;
  const char *at = text.data(), *const end = at + text.size();
  const auto first = std::from_chars(at, end, out.index);
  const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, out.of)
                            : std::from_chars_result{end, std::errc::invalid_argument};
  if (second.ec != std::errc{} || second.ptr != end || out.of < 1 || out.index < 0 ||
      out.index >= out.of)
    throw Failure(Exit::kUsage, {.code = "E-USAGE",
                                 .message = fmt::format("--share: '{}' is no share", text),
                                 .help = "I/N with I from 0 to N - 1: --share 0/8"});
  return out;
}

void note_others(const std::vector<fs::path>& others, Outcome& outcome) {
  if (others.empty()) return;
  const std::string first = display_name(others.front());
  outcome.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-FLEET-OTHER",
       .message =
           others.size() == 1
               ? first + " holds no cell.toml and is left out"
               : fmt::format("{} folders hold no cell.toml and are left out, the first is {}",
                             others.size(), first),
       .help = ""});
}

void warn_of_broken(const std::vector<fleet::CellSummary>& cells, Outcome& outcome) {
  int broken = 0;
  std::string first;
  for (const auto& cell : cells)
    if (!cell.ok && broken++ == 0)
      first = fmt::format("{} ({}: {})", cell.name, cell.error_code, cell.error);
  if (broken == 0) return;
  outcome.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-FLEET-CELL",
       .message = broken == 1
                      ? fmt::format("a cell could not be fitted: {}", first)
                      : fmt::format("{} cells could not be fitted, the first is {}", broken, first),
       .help = "see each by itself: plumb -C CELL fit"});
}

void warn_of_copies(const fleet::Fleet& all, Outcome& outcome) {
  if (all.copies.empty()) return;
  const auto& [copy, first] = *all.copies.begin();
  outcome.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-FLEET-COPY",
       .message = all.copies.size() == 1
                      ? fmt::format("{} has the same measurements as {}, so only one of the two "
                                    "teaches",
                                    copy, first)
                      : fmt::format("{} cells have the measurements of another one, so they teach "
                                    "nothing; the first is {}, as {}",
                                    all.copies.size(), copy, first),
       .help = "one folder for each arm; several days of one arm belong into one cell"});
}

/// The worst arm that is not good; null if all are.
const fleet::CellSummary* worst_of(const fleet::Fleet& all) {
  const fleet::CellSummary* out = nullptr;
  for (const auto& cell : all.cells)
    if (cell.ok && !cell.good && (out == nullptr || cell.held.mean > out->held.mean)) out = &cell;
  return out;
}

std::string next_of(const FleetArguments& options, const fleet::Fleet& all) {
  const auto in_cell = [&](const std::string& name, const char* verb) {
    return fmt::format("-C {} {}", shell_word((fs::path(options.folder) / name).string()), verb);
  };
  for (const auto& model : all.models)
    if (!model.sisters.odd.empty())
      return in_cell(model.sisters.odd.front().cell, "check   # are its data right?");
  if (const auto* worst = worst_of(all))
    return in_cell(worst->name, "diagnose   # what does the worst one lack?");
  return in_cell(all.cells.front().name, "compile   # and so every one");
}

void gather(const FleetArguments& options, const Globals& globals, const fs::path& results,
            std::vector<fleet::CellSummary> cells, Outcome& outcome) {
  const fleet::Fleet all = fleet::fleet_of(std::move(cells));
  outcome.result = show::fleet_json(all);
  Json file{{"schema", "fleet/1"}};
  file.update(outcome.result);
  const fs::path name = results / "fleet.json";
  write_file_atomically(name, to_text(file));
  outcome.result["file"] = name.string();
  const fs::path page = results / "fleet.html";
  write_file_atomically(page, report::fleet_report(all));
  outcome.result["report"] = page.string();
  outcome.text = show::fleet_text(all) +
                 fmt::format("\nwrote {} and {}\n", display_name(name), display_name(page));
  warn_of_copies(all, outcome);
  if (std::none_of(all.cells.begin(), all.cells.end(),
                   [](const fleet::CellSummary& cell) { return cell.ok; }))
    throw Failure(
        Exit::kInput,
        {.code = "E-FLEET-NONE",
         .message = fmt::format("none of the {} cells in {} could be fitted", all.cells.size(),
                                options.folder),
         .help = "see one by itself: plumb -C " +
                 shell_word((fs::path(options.folder) / all.cells.front().name).string()) +
                 " fit"});
  say_next(globals, next_of(options, all), outcome);
}

void run_fleet(const FleetArguments& options, const Globals& globals, Outcome& outcome) {
  const Share share = share_of_text(options.share);
  const fs::path results =
      options.output.empty() ? fs::path(options.folder) / "fleet" : fs::path(options.output);
  fleet::Folders folders = fleet::folders_in(options.folder);
  std::erase_if(folders.others, [&](const fs::path& other) {
    std::error_code ignored;
    return fs::equivalent(other, results, ignored);
  });
  note_others(folders.others, outcome);
  const auto cells = fleet::share_of(folders.cells, share.index, share.of);
  const auto asked = options.diagnose ? fleet::Asked::kDiagnosis : fleet::Asked::kFit;
  const int jobs = options.jobs > 0
                       ? options.jobs
                       : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<fleet::CellSummary> summaries;
  {
    Progress progress(
        fmt::format("{} {} cells", options.diagnose ? "diagnosing" : "fitting", cells.size()));
    // Where no terminal follows it, each of these is a line: a hundred of them are enough.
    const int all = static_cast<int>(cells.size()), step = std::max(1, all / 100);
    const fleet::ResultsFolder folder(results);
    summaries = fleet::summaries_of(cells, folder, asked, jobs, [&](int done) {
      if (done % step == 0 || done == all)
        progress.at(fmt::format("{} done, {} left", done, all - done));
    });
  }
  warn_of_broken(summaries, outcome);
  if (options.share.empty())
    return gather(options, globals, results, std::move(summaries), outcome);
  outcome.result = {{"share", options.share}, {"done", summaries.size()}};
  outcome.text = fmt::format("{} cells of share {} are done; when all shares are: plumb fleet {}\n",
                             summaries.size(), options.share, shell_word(options.folder));
}

}  // namespace

void add_fleet(Program& program) {
  const auto options = std::make_shared<FleetArguments>();
  VerbOptions verb = program.verb(
      {.name = "fleet",
       .summary = "Many cells: which arms are good, which is unlike its sisters",
       .examples =
           "  plumb fleet cells                     # every folder in cells/ with a cell.toml\n"
           "  plumb fleet cells --share 0/8         # an eighth of the work, for a scheduler",
       .in_cell = false},
      [options](const Globals& g, Outcome& o) { run_fleet(*options, g, o); });
  verb.add_option("FOLDER", options->folder,
                  "Folder that holds the cells; they are left as they are")
      .required();
  verb.add_option("-o,--output", options->output, "Folder for the results; else FOLDER/fleet")
      .type_name("DIR");
  verb.add_flag("--diagnose", options->diagnose,
                "Also search every cell for the effect that its model lacks; takes longer");
  verb.add_option("--jobs", options->jobs, "Cells at a time; else as many as there are processors")
      .check(whole_number_between(1, 1024));
  verb.add_option("--share", options->share,
                  "Only this share of the cells, and no table: 0/8 to 7/8")
      .type_name("I/N");
}

}  // namespace plumb::offline::cli
