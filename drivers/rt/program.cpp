// SPDX-License-Identifier: Apache-2.0
#include "rt/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "plumb/format/version.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr const char* kAbout =
    "The controller-side program: the real-time cycle between a target source and the robot "
    "controller.";
constexpr const char* kExamples =
    "  plumb-rt doctor                   # is this machine fit for a 4 ms cycle?\n"
    "  plumb-rt doctor --cycle-us 1000   # and for 1 kHz?";

/// Help that begins with the examples, which are kept in the footer.
class ExamplesFirst : public CLI::Formatter {
 public:
  ExamplesFirst() { column_width(34); }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const bool first = mode == CLI::AppFormatMode::Normal;
    return (first ? "Examples:\n" + app->get_footer() + "\n\n" : "") +
           CLI::Formatter::make_help(app, std::move(name), mode);
  }

  std::string make_footer(const CLI::App*) const override { return "\n"; }
};

void add_json(CLI::App& app, Globals& globals) {
  app.add_flag_callback(
      "--json", [&globals] { globals.output = Globals::Output::kJson; },
      "One JSON object on stdout; messages on stderr");
}

Outcome bug(const char* what) {
  Outcome out;
  out.exit = Exit::kBug;
  out.error =
      Error{.code = "E-BUG",
            .message = fmt::format("this is a bug in plumb-rt {}: {}", format::kVersion, what),
            .help = "report it with the command"};
  return out;
}

}  // namespace

Program::Program() : app_(kAbout, "plumb-rt") {
  app_.formatter(std::make_shared<ExamplesFirst>());
  app_.get_formatter()->label("SUBCOMMAND", "VERB");
  app_.footer(kExamples);
  app_.set_version_flag("--version", fmt::format("plumb-rt {}", format::kVersion));
  app_.set_help_flag("-h,--help", "Print this help");
  app_.require_subcommand(0, 1);
  app_.allow_extras();
  add_json(app_, globals_);
}

CLI::App& Program::verb(const VerbText& text, Action action) {
  CLI::App& sub = *app_.add_subcommand(text.name, text.summary);
  sub.group("Verbs");
  sub.allow_extras(false);
  sub.footer(text.examples);
  sub.set_help_flag("-h,--help", "Print this help");
  add_json(sub, globals_);
  actions_[text.name] = std::move(action);
  return sub;
}

int Program::run(int argc, char** argv) {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  try {
    app_.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return app_.exit(asked);
  } catch (const CLI::ParseError& error) {
    return usage_error(error.what(), words);
  }
  if (!app_.remaining().empty())
    return usage_error(fmt::format("'{}' is not a verb of plumb-rt", app_.remaining().front()),
                       words);
  if (app_.get_subcommands().empty()) return usage_error("no verb was given", words);
  return dispatch(app_.get_subcommands().front()->get_name());
}

int Program::dispatch(const std::string& verb) {
  Outcome outcome;
  try {
    actions_.at(verb)(outcome);
  } catch (const std::exception& error) {
    outcome = bug(error.what());
  }
  return report(verb, globals_, outcome);
}

int Program::usage_error(const std::string& message, const std::vector<std::string>& words) {
  if (std::find(words.begin(), words.end(), "--json") != words.end())
    globals_.output = Globals::Output::kJson;
  const auto verbs = app_.get_subcommands();
  const std::string name = verbs.empty() ? "" : verbs.front()->get_name();
  Outcome outcome;
  outcome.exit = Exit::kUsage;
  outcome.error = Error{.code = "E-USAGE",
                        .message = message,
                        .help = fmt::format("plumb-rt {}{}--help", name, name.empty() ? "" : " ")};
  return report(name.empty() ? "plumb-rt" : name, globals_, outcome);
}

}  // namespace plumb::drivers::rt
