// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "program/man_page.hpp"
#include "program/outcome.hpp"
#include "program/verb_options.hpp"

namespace CLI {
class ParseError;
}  // namespace CLI

namespace plumb {

/// What a verb does; may throw Failure, std::filesystem errors, or anything else (a bug).
using Action = std::function<void(const Globals&, Outcome&)>;

/// The words of a verb's help.
struct VerbText {
  std::string name;
  std::string summary;   // one line, without a full stop
  std::string examples;  // two lines that can be pasted
  bool in_cell = true;   // it works in the cell that -C names, if the program has cells
};

/// The words of a program's own help.
struct ProgramText {
  std::string name;
  std::string about;       // one sentence
  std::string examples;    // two lines that can be pasted
  std::string first;       // what to type when no verb was given
  ManualText manual = {};  // what its manual page says that its options do not
};

/// Whether the verbs of a program work in a cell, which is the folder of a cell.toml; -C names it.
enum class WorksIn { kAnywhere, kCell };

/// The command line: verbs with --json and --help, usage errors with "did you mean", the manual
/// page and the shell completions of all of these, and the way from what a verb throws to an exit
/// code.
class Program {
 public:
  Program(ProgramText text, WorksIn place);
  ~Program();

  /// A new verb; the caller adds its options. Verbs stand in the help in this order.
  VerbOptions verb(const VerbText& text, Action action);

  /// Parses, runs one verb, reports. Returns the exit code.
  int run(int argc, char** argv);

 private:
  void add_globals(CLI::App& app);
  int dispatch(const CLI::App& verb);
  void name_the_cell(std::vector<Problem>& problems) const;
  int no_verb();
  void add_pages();
  int print_page() const;
  int usage_error(const CLI::ParseError& error, const std::vector<std::string>& words);
  int unknown_verb(const std::string& word);
  std::vector<std::string> verb_names() const;

  ProgramText text_;
  WorksIn place_;
  std::unique_ptr<CLI::App> app_;
  Globals globals_;
  std::string page_;  // "man" or the shell of --completion; empty: neither was asked for
  std::map<std::string, Action> actions_;
  std::vector<std::string> cell_verbs_;
};

}  // namespace plumb
