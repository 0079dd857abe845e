// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "import/text_store.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// A foreign text file as UTF-8 lines, without line ends.
struct SourceText {
  std::string file;
  std::string sha256;
  std::shared_ptr<TextStore> texts;     // UTF-8; the lines point into it
  std::vector<std::string_view> lines;  // line n is lines[n - 1]
  std::vector<Problem> remarks;         // the encoding, if it was not UTF-8

  SourceText() = default;
  SourceText(const SourceText&) = delete;
  SourceText& operator=(const SourceText&) = delete;
};

/// Turns UTF-16 (with its mark or without) and Latin-1 (Windows-1252) into UTF-8 and says so.
/// Throws Failure (kInput): E-IMPORT-EMPTY, E-IMPORT-BINARY; E-IMPORT-ENCODING for Shift-JIS and
/// for text that cannot be Latin-1 (Chinese, Korean, Cyrillic), which would turn into nonsense.
void decode(std::string bytes, const std::string& file, SourceText& out);

/// What a file is that holds no table, by its first line that is not empty: "XML", "JSON", "YAML",
/// "a spreadsheet"; empty if it may be one.
std::string_view other_format(std::string_view line);

}  // namespace plumb::offline
