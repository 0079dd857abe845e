// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::offline::show {

/// A table set for a terminal: columns as wide as their widest cell, two spaces between, the first
/// one flush left and the others flush right.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) { rows_.push_back(std::move(header)); }

  /// From column `first` on, cells stand flush left (the first one always does).
  TextTable& left_from(std::size_t first) {
    left_from_ = first;
    return *this;
  }

  /// Missing cells at the end are empty.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

  /// Indented by two spaces, no trailing blanks, a newline after each row.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
  std::size_t left_from_ = static_cast<std::size_t>(-1);
};

/// Characters on screen of a UTF-8 text without combining marks.
std::size_t screen_width(const std::string& text);

}  // namespace plumb::offline::show
