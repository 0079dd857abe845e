// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "program/json.hpp"
#include "program/problem.hpp"
#include "program/verdict.hpp"

namespace plumb {

/// The options that every verb has.
struct Globals {
  std::string directory;  // -C; empty: look for cell.toml from here upward
  enum class Output { kText, kJson } output = Output::kText;
};

/// A file that was read as input.
struct InputFile {
  std::string file;
  std::string sha256;
};

/// The result of a verb. It is filled step by step, so after a failure it still lists the files
/// read.
// The JSON library makes null by a constructor that may throw for other values, never for this one.
// NOLINTNEXTLINE(bugprone-exception-escape)
struct Outcome {
  std::vector<InputFile> inputs;
  /// Files, and folders with all that is in them, that belong to what the verb works on: no output
  /// of it may replace them.
  std::vector<std::filesystem::path> kept;
  std::vector<Problem> remarks;   // warnings and notes
  Json result;                    // null until there is one
  std::string text;               // for people; the first line is the verdict
  std::vector<Verdict> verdicts;  // of the text, unless the result has a verdict_class
  std::vector<Problem> errors;
  Exit exit = Exit::kDone;

  void remark(const std::vector<Problem>& more) {
    remarks.insert(remarks.end(), more.begin(), more.end());
  }
};

}  // namespace plumb
