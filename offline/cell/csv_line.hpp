// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb::offline {

/// One cell of a line: its text without outer spaces and quotes, inside the line it came from.
struct CsvCell {
  std::string_view text;
  bool quoted = false;  // "" inside stands for one quote
};

/// Why a line cannot be cut.
enum class CsvFault { kNone, kQuoteNotClosed, kTextAfterQuote };

/// Cuts a line at `separator`; cells in quotes may hold it. On a fault the last cell says where.
/// Cost: one pass; no allocation once `cells` has grown.
CsvFault cut_line(std::string_view line, char separator, std::vector<CsvCell>& cells);

/// The text meant by a cell.
std::string text_of(const CsvCell& cell);

/// A text as a cell: in quotes where it would be read otherwise.
std::string quoted_if_needed(const std::string& text);

}  // namespace plumb::offline
