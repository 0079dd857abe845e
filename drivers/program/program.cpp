// SPDX-License-Identifier: Apache-2.0
#include "program/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <new>
#include <tuple>

#include "plumb/format/version.hpp"
#include "program/command_table.hpp"
#include "program/completion.hpp"
#include "program/guarded.hpp"
#include "program/help_text.hpp"
#include "program/interrupt.hpp"
#include "program/machine_code.hpp"
#include "program/report.hpp"
#include "program/screen.hpp"
#include "program/shell_word.hpp"

namespace plumb {
namespace {

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> out;
  for (const auto* option : app.get_options())
    for (const auto& name : option->get_lnames()) out.push_back("--" + name);
  return out;
}

/// The option of the message, "--sed", if it is an unknown one.
std::string unknown_option(const CLI::App& verb) {
  const auto rest = verb.remaining();
  const auto it = std::find_if(rest.begin(), rest.end(),
                               [](const auto& word) { return word.starts_with("-"); });
  return it == rest.end() ? "" : *it;
}

std::string option_help(const CLI::App& verb, const std::string& command) {
  const std::string option = unknown_option(verb);
  if (const auto near = did_you_mean(option, option_names(verb)); !option.empty() && near)
    return fmt::format("did you mean '{}'?", *near);
  return command + " --help";
}

/// No file that is opened later may get the number of a standard stream that is closed, or what is
/// said would go into it. What stands there cannot be written, like a closed stream.
void keep_standard_numbers() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(number, F_GETFD) < 0) std::ignore = ::open("/dev/null", O_RDONLY);
}

}  // namespace

Program::Program(ProgramText text, WorksIn place)
    : text_(std::move(text)),
      place_(place),
      app_(std::make_unique<CLI::App>(text_.about, text_.name)) {
  app_->formatter(std::make_shared<ExamplesFirst>());
  app_->get_formatter()->label("SUBCOMMAND", "VERB");
  app_->footer(text_.examples);
  app_->set_version_flag("--version",
                         fmt::format("{} {} ({})", text_.name, format::kVersion, machine_code()));
  app_->set_help_flag("-h,--help", "Print this help");
  app_->require_subcommand(0, 1);
  app_->allow_extras();
  add_globals(*app_);
  add_pages();
}

Program::~Program() = default;

void Program::add_globals(CLI::App& app) {
  if (place_ == WorksIn::kCell)
    app.add_option("-C", globals_.directory, "Folder of the cell; else the nearest one upward")
        ->type_name("DIR");
  app.add_flag_callback(
      "--json", [this] { globals_.output = Globals::Output::kJson; },
      "One JSON object on stdout; messages on stderr");
}

/// Adds the options that only the program itself takes, no verb.
void Program::add_pages() {
  app_->add_flag_callback(
      "--man", [this] { page_ = "man"; }, "Print the manual page, in roff");
  app_->add_option("--completion", page_, "Print the completion script of a shell")
      ->type_name("bash|zsh|fish")
      ->check(one_of({"bash", "zsh", "fish"}, InHelp::kHidden).rule());
}

int Program::print_page() const {
  const CommandTable table = command_table(*app_);
  std::string page;
  if (page_ == "man") {
    ManualText manual = text_.manual;
    manual.version = format::kVersion;
    page = man_page(table, manual);
  } else {
    page = page_ == "bash"  ? bash_completion(table)
           : page_ == "zsh" ? zsh_completion(table)
                            : fish_completion(table);
  }
  return print_verbatim(page);
}

VerbOptions Program::verb(const VerbText& text, Action action) {
  CLI::App& sub = *app_->add_subcommand(text.name, text.summary);
  sub.group("Verbs");
  sub.allow_extras(false);
  sub.footer(text.examples);
  sub.set_help_flag("-h,--help", "Print this help");
  add_globals(sub);
  actions_[text.name] = std::move(action);
  if (place_ == WorksIn::kCell && text.in_cell) cell_verbs_.push_back(text.name);
  return VerbOptions(&sub);
}

std::vector<std::string> Program::verb_names() const {
  std::vector<std::string> out;
  for (const auto& [name, action] : actions_) out.push_back(name);
  return out;
}

int Program::run(int argc, char** argv) {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  // "plumb help fit" is "plumb fit --help".
  std::vector<std::string> parsed = words;
  if (!parsed.empty() && parsed.front() == "help") {
    parsed.erase(parsed.begin());
    parsed.emplace_back("--help");
  }
  std::reverse(parsed.begin(), parsed.end());  // as CLI11 wants them
  keep_standard_numbers();
  // Exceeding a file size limit shall be a reported write error instead of ending the program.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    app_->parse(std::move(parsed));
  } catch (const CLI::CallForHelp&) {
    return print_verbatim(laid_out_help(app_->help(), screen_of(STDOUT_FILENO)));
  } catch (const CLI::Success& asked) {
    return app_->exit(asked);
  } catch (const CLI::ParseError& error) {
    return usage_error(error, words);
  }
  const auto verbs = app_->get_subcommands();
  const auto rest = app_->remaining();
  if (!rest.empty()) return unknown_verb(rest.front());
  if (!page_.empty()) return print_page();
  if (!verbs.empty()) return dispatch(*verbs.front());
  return no_verb();
}

int Program::no_verb() {
  std::cerr << laid_out_help(app_->help(), screen_of(STDERR_FILENO));
  Outcome outcome;
  outcome.exit = Exit::kUsage;
  outcome.errors.push_back(
      {.code = "E-USAGE", .message = "no verb was given", .help = text_.first});
  return report({text_.name, ""}, globals_, outcome);
}

/// A command in a help line works in the same cell: "plumb fit" becomes "plumb -C cell fit".
void Program::name_the_cell(std::vector<Problem>& problems) const {
  if (globals_.directory.empty()) return;
  const std::string with_cell = command_in(text_.name, globals_.directory);
  for (Problem& problem : problems)
    for (const std::string& verb : cell_verbs_) {
      const std::string plain = text_.name + " " + verb;
      for (std::size_t at = 0; (at = problem.help.find(plain, at)) != std::string::npos;
           at += with_cell.size()) {
        const std::size_t end = at + plain.size();
        const bool whole = end == problem.help.size() ||
                           std::isalnum(static_cast<unsigned char>(problem.help[end])) == 0;
        if (whole) problem.help.replace(at, text_.name.size() + 1, with_cell);
      }
    }
}

int Program::dispatch(const CLI::App& verb) {
  const std::string& name = verb.get_name();
  Outcome interrupted;
  interrupted.exit = Exit::kInterrupted;
  interrupted.errors.push_back({.code = "E-INTERRUPTED", .message = "interrupted"});
  const bool json = globals_.output == Globals::Output::kJson;
  end_on_interrupt(json ? to_text(envelope({text_.name, name}, interrupted)) : "");
  Outcome outcome;
  guarded(
      text_.name, [&] { actions_.at(name)(globals_, outcome); }, outcome);
  name_the_cell(outcome.errors);
  name_the_cell(outcome.remarks);
  return report({text_.name, name}, globals_, outcome);
}

int Program::usage_error(const CLI::ParseError& error, const std::vector<std::string>& words) {
  if (std::find(words.begin(), words.end(), "--json") != words.end())
    globals_.output = Globals::Output::kJson;
  const auto verbs = app_->get_subcommands();
  const std::string name = verbs.empty() ? "" : verbs.front()->get_name();
  Outcome outcome;
  outcome.exit = Exit::kUsage;
  outcome.errors.push_back(
      {.code = "E-USAGE",
       .message = error.what(),
       .help = option_help(verbs.empty() ? *app_ : *verbs.front(), full_name({text_.name, name}))});
  return report({text_.name, name}, globals_, outcome);
}

int Program::unknown_verb(const std::string& word) {
  Outcome outcome;
  outcome.exit = Exit::kUsage;
  const bool option = word.starts_with("-");
  const auto near = did_you_mean(word, option ? option_names(*app_) : verb_names());
  outcome.errors.push_back({.code = "E-USAGE-VERB",
                            .message = fmt::format("'{}' is not {} of {}", word,
                                                   option ? "an option" : "a verb", text_.name),
                            .help = near ? fmt::format("did you mean '{} {}'?", text_.name, *near)
                                         : text_.name + " --help"});
  return report({text_.name, ""}, globals_, outcome);
}

}  // namespace plumb
