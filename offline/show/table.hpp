// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace plumb::offline::show {

/// A table of words and numbers as it is shown on a terminal (text_of) and on a page
/// (report::Html::table). The first column stands flush left, the others flush right.
struct Table {
  std::string name = {};     // for programs: "errors", "candidates"
  std::string caption = {};  // of a page; on a terminal only where `captioned`
  bool captioned = false;
  bool goes_on = false;  // on a terminal: no empty line before it
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows = {};  // missing cells at the end are empty
  std::size_t left_from = std::numeric_limits<std::size_t>::max();  // from here on flush left
  /// For few columns of long words, on a terminal: a line for each row, "first: second; head
  /// third".
  bool as_lines = false;
  std::vector<std::string> last_class = {};  // of a page: of the last cell of each row; else none

  void add(std::vector<std::string> row) { rows.push_back(std::move(row)); }
};

/// Set for a terminal, nothing without rows: columns as wide as their widest cell, two spaces
/// between; indented by two spaces, no trailing blanks, a newline after each row.
std::string text_of(const Table& table);

/// Characters on screen of a UTF-8 text without combining marks.
std::size_t screen_width(const std::string& text);

}  // namespace plumb::offline::show
