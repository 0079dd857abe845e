// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_replay.hpp"

#include <fmt/format.h>

#include <memory>

#include "program/file.hpp"
#include "rt/replay.hpp"

namespace plumb::drivers::rt {
namespace {

struct ReplayOptions {
  std::string file;
  std::string dir = ".";
  std::vector<std::string> models;
};

Json to_json(const Replayed& replayed) {
  return {{"same", replayed.same()},
          {"lines", replayed.lines},
          {"unreadable", replayed.unreadable},
          {"gaps", replayed.gaps},
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
  if (replayed.gaps > 0) return fmt::format("{} gaps in the record", replayed.gaps);
  if (replayed.unreadable > 0) return fmt::format("{} lines are no record", replayed.unreadable);
  return replayed.first_difference;
}

void play(const ReplayOptions& options, Outcome& outcome) {
  std::ignore = read_file(options.file);  // its own words, if it is not there
  const Deployment deployment = load_deployment(options.dir);
  std::vector<RunningModel> others;
  for (const auto& file : options.models)
    others.push_back(load_model(file, deployment.model.loaded->model().serial));
  const Replayed replayed = replay(options.file, deployment, others);
  outcome.result = to_json(replayed);
  outcome.text =
      fmt::format("{}: {} cycles, {} messages, {} frames said, {} of them otherwise\n",
                  replayed.same() ? "the same to the bit" : "not the same", replayed.cycles,
                  replayed.messages, replayed.frames, replayed.different);
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
           "  plumb-rt replay record.log --dir /etc/plumb/cell4\n"
           "  plumb-rt replay record.log --dir deployed --model better.plumb  # swapped to"},
      [options](const Globals&, Outcome& outcome) { play(*options, outcome); });
  verb.add_option("FILE", options->file, "The record: [log] record in rt.toml").required();
  verb.add_option("--dir", options->dir, "The folder that ran").shows_default();
  verb.add_option("--model", options->models,
                  "A model that was swapped to, or that the run began with; repeatable");
}

}  // namespace plumb::drivers::rt
