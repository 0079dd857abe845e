// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "rt/outcome.hpp"

namespace plumb::drivers::rt {

using Action = std::function<void(Outcome&)>;

/// The words of a verb's help.
struct VerbText {
  std::string name;
  std::string summary;   // one line, without a full stop
  std::string examples;  // two lines that can be pasted
};

/// The command line: verbs with --json and --help, and the way from what went wrong to an exit
/// code.
class Program {
 public:
  Program();

  /// A new verb; the caller adds its options.
  CLI::App& verb(const VerbText& text, Action action);

  /// Parses, runs one verb, reports. Returns the exit code.
  int run(int argc, char** argv);

 private:
  int dispatch(const std::string& verb);
  int usage_error(const std::string& message, const std::vector<std::string>& words);

  CLI::App app_;
  Globals globals_;
  std::map<std::string, Action> actions_;
};

}  // namespace plumb::drivers::rt
