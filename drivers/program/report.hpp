// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "program/outcome.hpp"

namespace plumb {

/// What was asked for; no verb: the program itself.
struct Command {
  std::string program;
  std::string verb;
};

/// "plumb fit"
std::string full_name(const Command& command);

/// The one object of --json: {schema, ok, command, version, inputs, warnings, result, error}.
Json envelope(const Command& command, const Outcome& outcome);

/// Remarks and errors on stderr, the result on stdout. Returns the exit code: that of the outcome,
/// or kEnvironment if stdout cannot be written.
int report(const Command& command, const Globals& globals, const Outcome& outcome);

/// For a program that others supervise: whoever does not read what report() says within a second
/// misses it, and what cannot be written does not change the exit code.
void hurry_readers();

/// Text for another program, such as a shell, on stdout as it is. Returns kDone, or kEnvironment if
/// stdout cannot be written.
int print_verbatim(const std::string& text);

}  // namespace plumb
