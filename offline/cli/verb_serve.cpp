// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/cell_data.hpp"
#include "cli/verbs.hpp"
#include "workbench/workbench.hpp"

namespace plumb::offline::cli {
namespace {

struct ServeArguments {
  int port = 0;
  bool open = false;
};

/// Prints the address at once, because the verb ends only when the user stops it. With --json it
/// goes to stderr, because stdout is for the result.
void say_address(const std::string& url, const Globals& globals) {
  std::FILE* const to = globals.output == Globals::Output::kJson ? stderr : stdout;
  std::fputs((url + "\n").c_str(), to);
  std::fflush(to);
}

void serve(const ServeArguments& options, const Globals& globals, Outcome& outcome) {
  const std::filesystem::path file = std::filesystem::absolute(cell_file(globals));
  workbench::serve({file, options.port}, [&](const std::string& url) {
    outcome.result = {{"url", url}, {"folder", file.parent_path().string()}};
    say_address(url, globals);
    if (options.open && !workbench::open_in_browser(url))
      std::fputs("no browser could be started: open the address yourself\n", stderr);
  });
  outcome.text = "The workbench was closed.\n";
}

}  // namespace

void add_serve(Program& program) {
  const auto options = std::make_shared<ServeArguments>();
  VerbOptions verb = program.verb(
      {.name = "serve",
       .summary = "The workbench: a page in the browser for the cell, on this machine only",
       .examples = "  plumb -C mycell serve --open      # until Ctrl-C\n"
                   "  plumb serve --port 8040           # prints the address to open"},
      [options](const Globals& g, Outcome& o) { serve(*options, g, o); });
  verb.add_option("--port", options->port, "TCP port of 127.0.0.1; 0: any that is free")
      .check(whole_number_between(0, 65535))
      .shows_default();
  verb.add_flag("--open", options->open, "Open the page in the browser of the desktop");
}

}  // namespace plumb::offline::cli
