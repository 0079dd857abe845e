// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace plumb {

/// One option, or one positional word, of a program or of a verb.
struct OptionRow {
  std::vector<std::string> names;  // "-o", "--output"; of a positional word its name alone
  std::string value;               // what the help calls its value; empty: it takes none
  std::vector<std::string> words;  // the only values it takes, if they can be listed
  std::string range;               // the numbers it takes, such as "[1 - 1000]", if limited
  std::string preset;              // its value if it is not given, if the help shows one
  std::string help;
  bool required = false;
  bool repeated = false;  // it takes several values
};

struct VerbRow {
  std::string name, summary, examples;
  std::vector<OptionRow> positionals, options;
};

/// A file that a program reads or writes by itself.
struct FileRow {
  std::string name, what;
};

/// All that the command line of a program takes, in the order of its help. The manual page and the
/// shell completions are written from it.
struct CommandTable {
  std::string program, about, examples;
  std::vector<OptionRow> options;  // of the program; every verb takes most of them too
  std::vector<VerbRow> verbs;
};

CommandTable command_table(const CLI::App& program);

}  // namespace plumb
