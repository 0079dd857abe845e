// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::offline::show {

/// Rows of a CSV file passed through as written, with columns that plumb adds ("ours") behind them.
/// A column of ours takes the place of an input column of the same name.
class PassThrough {
 public:
  PassThrough(std::string_view raw_header, const std::vector<std::string>& ours);

  /// With its line break.
  const std::string& header() const { return header_; }

  /// Input columns that ours replace.
  const std::vector<std::string>& replaced() const { return replaced_; }

  /// Appends a row with its line break. ours: one cell a column, in the order of the constructor.
  void append(std::string_view raw_row, std::span<const std::string_view> ours,
              std::string& out) const;

 private:
  std::vector<int> own_of_input_;    // which of ours replaces this input column, or -1
  std::vector<std::size_t> behind_;  // those of ours that replace none
  std::string header_;
  std::vector<std::string> replaced_;
};

/// Cells of a row as written, quotes kept.
void split_raw(std::string_view row, std::vector<std::string_view>& cells);

}  // namespace plumb::offline::show
