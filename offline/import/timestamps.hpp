// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb::offline {

/// Time stamps of a file as seconds from the first, or why they cannot be used.
struct Timestamps {
  std::vector<double> seconds;  // empty if unusable
  std::string format;           // "ISO 8601", "spreadsheet days", ...
  std::string damage;           // why unusable: "the spreadsheet kept six digits: 2,02011E+13"
  std::size_t damaged_row = 0;
  bool wrapped = false;  // a clock without date passed midnight
};

/// Understands ISO 8601, 20200714163904, 14.07.2020 16:39:04, days since 1900 of a spreadsheet, and
/// clocks without a date. One column, one format.
Timestamps read_timestamps(const std::vector<std::string_view>& cells, char decimal);

}  // namespace plumb::offline
