// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_replay.hpp"

#include <fmt/format.h>

#include <memory>

#include "program/file.hpp"
#include "rt/place.hpp"
#include "rt/record_files.hpp"
#include "rt/replay.hpp"

namespace plumb::drivers::rt {
namespace {

struct ReplayOptions {
  std::vector<std::string> files;
  std::string dir;
  std::vector<std::string> models;
};

Json to_json(const Replayed& replayed) {
  return {{"same", replayed.same()},
          {"files", replayed.files},
          {"lines", replayed.lines},
          {"unreadable", replayed.unreadable},
          {"torn", replayed.torn},
          {"gaps", replayed.gaps},
          {"beginnings", replayed.beginnings},
          {"unchecked", replayed.unchecked},
          {"cycles", replayed.cycles},
          {"messages", replayed.messages},
          {"frames", replayed.frames},
          {"different", replayed.different},
          {"first_difference", replayed.first_difference},
          {"swaps", replayed.swaps},
          {"unknown_model", replayed.unknown_model ? Json(*replayed.unknown_model) : Json()},
          {"state", to_string(replayed.report.state)},
          {"answered", replayed.report.counters.answered}};
}

std::string why(const Replayed& replayed) {
  if (replayed.unknown_model)
    return fmt::format("it goes on with model {}, which was not given", *replayed.unknown_model);
  if (replayed.different > 0) return replayed.first_difference;
  if (replayed.unreadable > 0) return fmt::format("{} lines are no record", replayed.unreadable);
  return fmt::format("{} cycles cannot be compared: the record does not say how its session was",
                     replayed.unchecked);
}

/// The folder that ran: the one that is named, or the folder to replay if it is one, or this one.
std::string folder_that_ran(const ReplayOptions& options) {
  if (!options.dir.empty()) return options.dir;
  std::error_code ignored;
  const std::filesystem::path first = options.files.front();
  return std::filesystem::exists(first / "rt.toml", ignored) || is_place(first) ? first.string()
                                                                                : ".";
}

void play(const ReplayOptions& options, Outcome& outcome) {
  for (const auto& file : options.files)
    if (!std::filesystem::exists(file)) std::ignore = read_file(file);  // its own words
  const Deployment deployment = load_deployment(folder_that_ran(options));
  const auto files = record_files(options.files, deployment.config.record.file);
  std::vector<RunningModel> others;
  for (const auto& file : options.models)
    others.push_back(load_model(file, deployment.model.loaded->model().serial));
  const Replayed replayed = replay(files, deployment, others);
  outcome.result = to_json(replayed);
  outcome.text =
      fmt::format("{}: {} cycles, {} messages, {} frames said, {} of them otherwise\n",
                  replayed.same() ? "the same to the bit" : "not the same", replayed.cycles,
                  replayed.messages, replayed.frames, replayed.different);
  if (replayed.beginnings > 1)
    outcome.text += fmt::format("{} files, {} beginnings: of runs, and where the record paused\n",
                                replayed.files, replayed.beginnings);
  if (replayed.same()) return;
  outcome.exit = Exit::kGateFailed;
  outcome.errors = {{.code = "E-RT-REPLAY-DIFFERS",
                     .message = why(replayed),
                     .help = replayed.unknown_model ? "plumb-rt replay ... --model FILE"
                                                    : "replay with the rt.toml of the record"}};
}

}  // namespace

void add_replay(Program& program) {
  const auto options = std::make_shared<ReplayOptions>();
  VerbOptions verb = program.verb(
      {.name = "replay",
       .summary = "A record through the same session, offline: does it decide the same?",
       .examples =
           "  plumb-rt replay /var/lib/plumb/cell4        # the whole record that its rt.toml "
           "names\n"
           "  plumb-rt replay record.log --dir /var/lib/plumb/cell4\n"
           "  plumb-rt replay record.log --dir deployed --model better.plumb  # swapped to"},
      [options](const Globals&, Outcome& outcome) { play(*options, outcome); });
  verb.add_option("FILE", options->files,
                  "Files of a record in their order, snapshots, or a folder with them")
      .required();
  verb.add_option("--dir", options->dir,
                  "The folder that ran; else FILE, if it is one, else the present folder");
  verb.add_option("--model", options->models,
                  "A model that was swapped to, or that the run began with; repeatable");
}

}  // namespace plumb::drivers::rt
