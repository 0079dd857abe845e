// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/cell_data.hpp"
#include "cli/given_frames.hpp"
#include "cli/model_file.hpp"
#include "cli/program_filter.hpp"
#include "cli/progress.hpp"
#include "cli/start_joints.hpp"
#include "cli/verbs.hpp"
#include "program/counted_words.hpp"
#include "program/file.hpp"
#include "program/printable.hpp"
#include "programs/lexer.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;
using programs::Language;

constexpr double kCoarse_m = 1e-5;  // more that the digits leave out is worth a note
constexpr long kMostDecimals = 6;   // of a millimetre: a nanometre

struct FilterArguments {
  std::vector<std::string> programs, tools, frames;
  std::string model, folder = "filtered";
  std::optional<std::string> start;
  bool joint_targets = false, robot_stands = false;
  int decimals = 0;
  WriteOptions write;
};

struct Work {
  const Language* language;
  programs::Program program;
  Filtered done = {};
};

[[noreturn]] void refuse_file(const std::string& file, std::string code, std::string message,
                              std::string help, int line = 0) {
  throw Failure(Exit::kInput, {.code = std::move(code),
                               .message = std::move(message),
                               .place = Place{.file = file, .line = line},
                               .help = std::move(help)});
}

programs::Source open_program(const std::string& file, Outcome& outcome) {
  programs::Source out{.file = file, .bytes = read_file(file)};
  outcome.inputs.push_back({file, sha256(out.bytes)});
  if (out.bytes.find('\0') != std::string::npos)
    refuse_file(file, "E-FILTER-LANGUAGE",
                "it holds bytes that are no text: is it binary, or UTF-16?",
                "save it as text: ASCII, UTF-8 or the controller's own code page");
  if (const int line = programs::line_of_mark(out.bytes); line > 0)
    refuse_file(file, "E-FILTER-TWICE", "the targets of this program are corrected already",
                "filter the program as it was before", line);
  return out;
}

/// The data file beside a program, "x.dat" of "x.src"; empty if there is none.
fs::path data_file(const fs::path& file, const Language& language) {
  if (language.data.empty() ||
      !fs::is_directory(file.parent_path().empty() ? "." : file.parent_path()))
    return {};
  for (const auto& beside :
       fs::directory_iterator(file.parent_path().empty() ? fs::path(".") : file.parent_path())) {
    const fs::path name = beside.path().filename();
    if (name.stem() == file.stem() && name != file.filename() &&
        programs::lower_case(name.extension().string()) == language.data)
      return file.parent_path() / name;
  }
  return {};
}

/// The files of one program.
struct Opened {
  const Language* language;
  std::vector<programs::Source> sources;
};

std::vector<Opened> open_programs(const FilterArguments& options, Outcome& outcome) {
  std::vector<Opened> out;
  std::set<std::string> read;
  std::vector<std::string> order = options.programs;
  // What has a data file of its own comes first, and takes it along.
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return programs::lower_case(fs::path(a).extension().string()) != ".dat" &&
           programs::lower_case(fs::path(b).extension().string()) == ".dat";
  });
  for (const std::string& file : order) {
    const Language* const language = programs::language_of(file);
    if (language == nullptr)
      refuse_file(file, "E-FILTER-LANGUAGE",
                  "the ending of its name does not say what language the program is in",
                  "name it " + programs::known_endings());
    if (!read.insert(fs::weakly_canonical(file).string()).second) continue;
    std::vector<programs::Source> sources{open_program(file, outcome)};
    if (const fs::path data = data_file(file, *language); !data.empty())
      if (read.insert(fs::weakly_canonical(data).string()).second)
        sources.push_back(open_program(data.string(), outcome));
    out.push_back({language, std::move(sources)});
  }
  return out;
}

/// The programs in the order in which they were given; those of one language are read together.
std::vector<Work> read_all(std::vector<Opened> opened) {
  std::vector<Work> out;
  std::map<const Language*, std::vector<std::vector<programs::Source>>> sources;
  for (Opened& one : opened) {
    out.push_back({.language = one.language, .program = {}});
    sources[one.language].push_back(std::move(one.sources));
  }
  for (auto& [language, own] : sources) {
    auto programs = programs::read_programs(*language, std::move(own));
    auto next = programs.begin();
    for (Work& work : out)
      if (work.language == language) work.program = std::move(*next++);
  }
  return out;
}

fs::path output_of(const FilterArguments& options, const std::string& file) {
  return fs::path(options.folder) / fs::path(file).filename();
}

void refuse_no_folder(const fs::path& folder) {
  fs::path there = folder;  // the part of it that exists
  while (!there.empty() && !fs::exists(there)) there = there.parent_path();
  if (there.empty() || fs::is_directory(there)) return;
  throw Failure(Exit::kUsage,
                {.code = "E-USAGE",
                 .message = fmt::format("{} is a file, and a folder is meant", there.string()),
                 .help = "name a folder of the filtered programs: -o filtered"});
}

OutputFiles outputs(const FilterArguments& options, const std::vector<Work>& all) {
  refuse_no_folder(options.folder);
  OutputFiles out(options.folder);
  std::set<std::string> names;
  for (const Work& work : all)
    for (std::size_t s = 0; s < work.program.sources.size(); ++s) {
      const fs::path file = output_of(options, work.program.sources[s].file);
      if (!names.insert(file.string()).second)
        throw Failure(Exit::kUsage,
                      {.code = "E-USAGE",
                       .message = fmt::format("two programs would be written to {}", file.string()),
                       .help = "filter them one after the other, with -o"});
      out.add(file, work.done.bytes.empty() ? "" : work.done.bytes[s]);
    }
  return out;
}

Json program_json(const Work& work, bool with_diff) {
  const Filtered& done = work.done;
  Json out = {{"file", work.program.sources[0].file},
              {"language", work.language->name},
              {"targets", done.targets},
              {"corrected", done.corrected},
              {"changed", done.changed},
              {"refused", done.refused},
              {"joint_targets", done.joint_targets}};
  out["untouched"] = Json::array();
  for (const Untouched& one : done.untouched)
    out["untouched"].push_back({{"file", one.file},
                                {"line", one.line},
                                {"target", valid_utf8(one.name)},
                                {"why", valid_utf8(one.why)},
                                {"help", valid_utf8(one.help)}});
  out["largest_mm"] = show::to_mm(done.largest_m);
  out["rounding_mm"] = show::to_mm(done.rounding_m);
  if (done.linear_moves > 0)
    out["between_targets_mm"] = show::to_mm(done.between_m);
  else
    put_null(out, "between_targets_mm", "no linear move goes from a corrected target to another");
  if (!with_diff) return out;
  out["diff"] = "";
  for (std::size_t s = 0; s < done.bytes.size(); ++s) {
    const auto& source = work.program.sources[s];
    out["diff"] = out["diff"].get<std::string>() +
                  valid_utf8(programs::unified_diff(source.file, source.bytes, done.bytes[s]));
  }
  return out;
}

struct Sum {
  int targets = 0, corrected = 0, changed = 0, joint_targets = 0;
  double largest_m = 0.0, rounding_m = 0.0;
};

Sum sum_of(const std::vector<Work>& all) {
  Sum out;
  for (const auto& [language, program, done] : all) {
    out.targets += done.targets;
    out.corrected += done.corrected;
    out.changed += done.changed;
    out.joint_targets += done.joint_targets;
    out.largest_m = std::max(out.largest_m, done.largest_m);
    out.rounding_m = std::max(out.rounding_m, done.rounding_m);
  }
  return out;
}

std::string verdict(const std::vector<Work>& all, const Sum& sum) {
  std::string out = fmt::format("Corrected {} of {} in {}", sum.corrected,
                                counted_words(sum.targets, "target", "targets"),
                                counted_words(std::ssize(all), "program", "programs"));
  if (sum.corrected > 0)
    out += fmt::format("; the largest correction is {} mm", show::mm(sum.largest_m));
  if (sum.corrected > 0 && sum.changed == 0)
    out += ", less than the digits show: the programs stay as they are, byte for byte";
  if (sum.targets > sum.corrected)
    out +=
        fmt::format("; {} not touched", sum.targets - sum.corrected == 1
                                            ? "1 is"
                                            : fmt::format("{} are", sum.targets - sum.corrected));
  if (sum.joint_targets > 0)
    out += fmt::format("; {} left as they are (--joint-targets corrects them too)",
                       counted_words(sum.joint_targets, "joint target", "joint targets"));
  return out + ".\n";
}

std::string tables(const std::vector<Work>& all) {
  show::Table table{.head = {"program", "targets", "corrected", "refused", "largest [mm]",
                             "between targets [mm]"}};
  std::string listed;
  for (const auto& [language, program, done] : all) {
    table.add({printable_line(program.sources[0].file), std::to_string(done.targets),
               std::to_string(done.corrected), std::to_string(done.refused),
               show::mm(done.largest_m), done.linear_moves > 0 ? show::mm(done.between_m) : "-"});
    for (const Untouched& one : done.untouched)
      listed += printable_line(fmt::format("{}:{}: {}: {}. To do: {}", one.file, one.line, one.name,
                                           one.why, one.help)) +
                "\n";
  }
  std::string out = "\n" + show::text_of(table);
  return listed.empty() ? out : out + "\nNot touched:\n" + listed;
}

/// Without the carriage returns, which a terminal would obey.
std::string shown_diff(std::string text) {
  std::erase(text, '\r');
  return text;
}

void remark_all(const std::vector<Work>& all, const Sum& sum, Outcome& outcome) {
  std::set<std::string> tools;
  for (const Work& work : all)
    tools.insert(work.done.other_tools.begin(), work.done.other_tools.end());
  for (const std::string& tool : tools)
    outcome.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-FILTER-TOOL",
         .message = fmt::format("tool '{}' is not that of the model: its targets are right only if "
                                "the flange of the model is that of the controller",
                                printable_line(tool)),
         .help = "compare both at one pose: plumb explain W-FILTER-TOOL"});
  for (const Work& work : all)
    if (work.program.states_nothing)
      outcome.remarks.push_back(
          {.severity = Severity::kWarning,
           .code = "W-FILTER-EMPTY",
           .message = "no target, no move, no tool and no frame is found in it",
           .place = Place{.file = work.program.sources[0].file, .line = 0},
           .help = "if it has targets: plumb explain W-FILTER-EMPTY"});
  if (sum.rounding_m > kCoarse_m)
    outcome.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-FILTER-DIGITS",
         .message = fmt::format("the digits of the programs leave out up to {} mm of a correction",
                                show::mm(sum.rounding_m)),
         .help = "to write more of them: --decimals 3"});
}

void filter(const FilterArguments& options, const Globals& globals, Outcome& outcome) {
  const std::string file = !options.model.empty()
                               ? options.model
                               : (cell_file(globals).parent_path() / "robot.plumb").string();
  const format::Model model = open_model(file, outcome);
  keep_cells_around(globals, fs::path(options.folder) / "x", outcome);
  FilterSettings settings{
      .tools = given_frames("--tool", options.tools, &model.nominal.tool),
      .frames = given_frames("--frame", options.frames, nullptr),
      .start = start_of(options.start, model.nominal),
      .joint_targets = options.joint_targets,
      .robot_stands = options.robot_stands,
      .least_decimals = options.decimals,
      .mark = {.model = model.cell_name, .sha256 = outcome.inputs.back().sha256}};
  std::vector<Work> all = read_all(open_programs(options, outcome));
  outputs(options, all).check(options.write, outcome);
  ProgramFilter work(model, std::move(settings));
  for (Work& one : all) {
    const Progress progress("correcting the targets of " + one.program.sources[0].file);
    one.done = work.filter(*one.language, one.program);
  }
  const Sum sum = sum_of(all);
  outcome.result = Json::object();
  outcome.result["programs"] = Json::array();
  for (const Work& one : all)
    outcome.result["programs"].push_back(program_json(one, options.write.dry_run));
  outcome.remark(limited_remark(work.found()));
  outcome.remark(work.found().inputs.remarks());
  remark_all(all, sum, outcome);
  outcome.text = verdict(all, sum) + tables(all);
  if (sum.corrected == 0 && sum.targets > 0) {
    const auto& first = std::find_if(all.begin(), all.end(), [](const Work& one) {
                          return !one.done.untouched.empty();
                        })->done.untouched.front();
    outcome.exit = Exit::kNumbersSayNo;
    outcome.errors.push_back({.code = "E-FILTER-NONE",
                              .message = fmt::format("no target can be corrected; the first: {}",
                                                     printable_line(first.why)),
                              .place = Place{.file = first.file, .line = first.line},
                              .help = printable_line(first.help)});
    return;
  }
  outputs(options, all).commit(options.write, outcome);
  if (options.write.dry_run)
    for (const Json& one : outcome.result["programs"])
      outcome.text += "\n" + shown_diff(one["diff"].get<std::string>());
  else
    for (const Json& name : outcome.result["files"])
      outcome.text += "wrote " + name.get<std::string>() + "\n";
}

}  // namespace

void add_filter(plumb::Program& program) {
  const auto options = std::make_shared<FilterArguments>();
  VerbOptions verb = program.verb(
      {.name = "filter",
       .summary = "Robot programs with corrected targets: only digits of targets change",
       .examples = "  plumb filter weld.mod -o corrected\n"
                   "  plumb filter PICK.LS --tool 1=0,0,150,0,0,0 --frame 1=500,0,0,0,0,0"},
      [options](const Globals& g, Outcome& o) { filter(*options, g, o); });
  verb.add_option("PROGRAM", options->programs,
                  "Programs: RAPID .mod .prg, Fanuc .ls, KRL .src with its .dat, URScript .script")
      .required();
  verb.add_option("-o,--output", options->folder, "Folder of the filtered programs")
      .type_name("DIR")
      .shows_default();
  verb.add_option("--model", options->model,
                  "Model file of plumb compile; else robot.plumb beside cell.toml")
      .type_name("FILE");
  verb.add_option("--tool", options->tools,
                  "Pose of a tool in the flange [mm, deg about fixed axes, or a quaternion], or "
                  "NAME=model; NAME is 'default' where the program names none")
      .type_name("NAME=X,Y,Z,RX,RY,RZ")
      .one_value_each();
  verb.add_option("--frame", options->frames, "Pose of a work frame in the base, likewise")
      .type_name("NAME=X,Y,Z,RX,RY,RZ")
      .one_value_each();
  verb.add_option("--start", options->start,
                  "Joints before the first target [deg, mm], where no configuration is stated")
      .type_name("Q1,Q2,...");
  verb.add_flag("--joint-targets", options->joint_targets, "Correct targets of joints too");
  verb.add_flag("--robot-stands", options->robot_stands,
                "External axes carry neither the robot nor the work");
  verb.add_option(
          "--decimals", options->decimals,
          "Write at least so many decimals of a millimetre; else as many as the program has")
      .type_name("N")
      .check(whole_number_between(0, kMostDecimals));
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
