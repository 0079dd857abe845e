// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace plumb::drivers::rt {

using Json = nlohmann::ordered_json;

/// Process exit codes of plumb-rt.
enum class Exit : int {
  kClean = 0,
  kUsage = 2,
  kInput = 3,  // model, configuration or robot mismatch
  kEnvironment = 5,
  kBusLost = 6,
  kBug = 70,
};

/// Why nothing, or not everything, was done.
struct Error {
  std::string code;     // stable, for example "E-UNFIT"
  std::string message;  // one sentence without a full stop
  std::string help;     // one line that can be pasted
};

/// What every verb is told.
struct Globals {
  enum class Output { kText, kJson } output = Output::kText;
};

/// What a verb found out.
struct Outcome {
  Exit exit = Exit::kClean;
  Json result;       // null until there is one
  std::string text;  // the same for people
  std::optional<Error> error;
};

/// The one object of --json: {schema, ok, command, version, inputs, warnings, result, error}.
Json envelope(const std::string& verb, const Outcome& outcome);

/// The result on stdout, the error on stderr. Returns the exit code.
int report(const std::string& verb, const Globals& globals, const Outcome& outcome);

}  // namespace plumb::drivers::rt
