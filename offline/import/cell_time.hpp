// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace plumb::offline {

inline constexpr double kDay_s = 86400.0;

/// A cell read with the day first and with the month first; empty where that gives no date.
struct CellTime {
  std::string format;
  std::optional<double> day_first, month_first;
  bool either = false;  // written in an order that differs between countries
};

/// The time stamp in one cell, in the formats of `read_timestamps`; nothing if it holds none.
std::optional<CellTime> cell_time(std::string_view cell, char decimal);

/// True if plain numbers up to this one may be such a stamp; else they count seconds or
/// milliseconds from some start.
bool may_be_date(double number);

/// True if so many seconds after 1970 lie in the time of today's robots.
bool may_be_epoch(double seconds);

}  // namespace plumb::offline
