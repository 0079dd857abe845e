// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_events.hpp"

#include <fmt/format.h>

#include <memory>

#include "rt/deployment.hpp"
#include "rt/journal.hpp"

namespace plumb::drivers::rt {
namespace {

struct EventOptions {
  std::string dir = ".";
  std::string file;
  int most = 1000;
};

/// The journal of the folder; its configuration need not be sound, so that what led to a refusal
/// can be read.
std::filesystem::path file_of(const EventOptions& options) {
  if (!options.file.empty()) return options.file;
  const auto places = journal_places(options.dir);
  for (const auto& place : places) {
    std::error_code ignored;
    if (std::filesystem::exists(place, ignored)) return place;
  }
  return places.front();
}

void show_events(const EventOptions& options, Outcome& outcome) {
  const auto file = file_of(options);
  const auto events = read_events(file, static_cast<std::size_t>(options.most));
  outcome.result = {{"file", file.string()}, {"events", events}};
  if (events.empty()) {
    outcome.text = fmt::format("No events in {}.\n", file.string());
    return;
  }
  outcome.text = fmt::format("{} events, the newest last:\n", events.size());
  for (const Json& event : events) outcome.text += event_text(event) + "\n";
}

}  // namespace

void add_events(Program& program) {
  const auto options = std::make_shared<EventOptions>();
  VerbOptions verb = program.verb(
      {.name = "events",
       .summary =
           "What happened: states, faults, lost inputs, refusals and swaps, with their times",
       .examples = "  plumb-rt events /etc/plumb/cell4\n"
                   "  plumb-rt events /etc/plumb/cell4 --most 20 --json"},
      [options](const Globals&, Outcome& outcome) { show_events(*options, outcome); });
  verb.add_option("DIR", options->dir, "The folder that runs or ran").shows_default();
  verb.add_option("--file", options->file, "The journal, if [log] events of rt.toml names another")
      .type_name("FILE");
  verb.add_option("--most", options->most, "The newest so many")
      .check(whole_number_between(1, 100000))
      .shows_default();
}

}  // namespace plumb::drivers::rt
