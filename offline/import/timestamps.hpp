// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "import/cell_column.hpp"

namespace plumb::offline {

/// Which number of 03/04/2022 is the day.
enum class DateOrder { kUnknown, kDayFirst, kMonthFirst };

/// Time stamps of a file as seconds from the first, or why they cannot be used.
struct Timestamps {
  std::vector<double> seconds;  // empty if unusable
  double first = 0.0;           // of the first stamp: since 1970, or of the day
  std::string format;           // "ISO 8601", "DD.MM.YYYY hh:mm", "spreadsheet days", ...
  std::string damage;           // why unusable: "the spreadsheet kept six digits: 2,02011E+13"
  std::size_t damaged_row = 0;
  bool wrapped = false;    // a clock without date passed midnight
  bool undecided = false;  // day and month cannot be told apart, and it matters: nothing is usable
};

/// Understands ISO 8601, 20200714163904, dates with . / - or with a month's name followed by a time
/// with or without seconds, am and pm, days since 1900 of a spreadsheet, seconds since 1970 and
/// thousandths, millionths and billionths of them, and clocks without a date. One column, one
/// format. Whether day or month comes first is what `order` says, else the numbers beyond 12 of the
/// whole column tell; with points the day comes first.
Timestamps read_timestamps(const CellColumn& cells, char decimal,
                           DateOrder order = DateOrder::kUnknown);

}  // namespace plumb::offline
