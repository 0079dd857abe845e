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
          {"model_changed", replayed.model_changed},
          {"state", to_string(replayed.report.state)},
          {"answered", replayed.report.counters.answered}};
}

std::string why(const Replayed& replayed) {
  if (replayed.model_changed) return "it goes on with a model that the folder does not hold";
  if (replayed.gaps > 0) return fmt::format("{} gaps in the record", replayed.gaps);
  if (replayed.unreadable > 0) return fmt::format("{} lines are no record", replayed.unreadable);
  return replayed.first_difference;
}

void play(const ReplayOptions& options, Outcome& outcome) {
  std::ignore = read_file(options.file);  // its own words, if it is not there
  const Replayed replayed = replay(options.file, load_deployment(options.dir));
  outcome.result = to_json(replayed);
  outcome.text =
      fmt::format("{}: {} cycles, {} messages, {} frames said, {} of them otherwise\n",
                  replayed.same() ? "the same to the bit" : "not the same", replayed.cycles,
                  replayed.messages, replayed.frames, replayed.different);
  if (replayed.same()) return;
  outcome.exit = Exit::kGateFailed;
  outcome.errors = {{.code = "E-RT-REPLAY-DIFFERS",
                     .message = why(replayed),
                     .help = "replay with the model and rt.toml of the record"}};
}

}  // namespace

void add_replay(Program& program) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App& verb = program.verb(
      {.name = "replay",
       .summary = "A record through the same session, offline: does it decide the same?",
       .examples = "  plumb-rt replay record.log --dir /etc/plumb/cell4\n"
                   "  plumb-rt replay record.log --dir deployed --json"},
      [options](const Globals&, Outcome& outcome) { play(*options, outcome); });
  verb.add_option("FILE", options->file, "The record: [log] record in rt.toml")->required();
  verb.add_option("--dir", options->dir, "The folder that ran")->capture_default_str();
}

}  // namespace plumb::drivers::rt
