// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_events.hpp"

#include <fmt/format.h>

#include <memory>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"
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
  if (!std::filesystem::is_directory(options.dir))
    throw Failure(Exit::kInput, {.code = "E-READ",
                                 .message = fmt::format("there is no folder {}", options.dir),
                                 .help = "name the folder that runs or ran: plumb-rt events DIR"});
  const auto places = journal_places(options.dir);
  for (const auto& place : places) {
    std::error_code ignored;
    if (std::filesystem::exists(place, ignored)) return place;
  }
  return places.front();
}

void show_events(const EventOptions& options, Outcome& outcome) {
  const auto file = file_of(options);
  if (!options.file.empty() && !std::filesystem::is_regular_file(file))
    std::ignore = read_regular_file(file, 0);  // says in its own words what is wrong
  const auto [events, damaged] = read_events(file, static_cast<std::size_t>(options.most));
  outcome.result = {{"file", file.string()}, {"events", events}, {"damaged", damaged}};
  if (damaged > 0)
    outcome.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-RT-EVENTS",
         .message = fmt::format("{} lines of {} are no events and were left out: a program was "
                                "killed while it wrote, or somebody edited them",
                                damaged, display_name(file)),
         .help = "grep -n -v '^{.*}$' " + shell_word(display_name(file))});
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
       .examples = "  plumb-rt events /var/lib/plumb/cell4\n"
                   "  plumb-rt events /var/lib/plumb/cell4 --most 20 --json"},
      [options](const Globals&, Outcome& outcome) { show_events(*options, outcome); });
  verb.add_option("DIR", options->dir, "The folder that runs or ran").shows_default();
  verb.add_option("--file", options->file, "The journal, if [log] events of rt.toml names another")
      .type_name("FILE");
  verb.add_option("--most", options->most, "The newest so many")
      .check(whole_number_between(1, 100000))
      .shows_default();
}

}  // namespace plumb::drivers::rt
