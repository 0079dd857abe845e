// SPDX-License-Identifier: Apache-2.0
#include "import/timestamps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "import/cell_time.hpp"
#include "import/number_text.hpp"

namespace plumb::offline {
namespace {

/// No measurement takes longer.
constexpr double kMostDays = 1000.0;

std::string damage_of(std::string_view cell) {
  if (number_in(cell, '.') || number_in(cell, ','))
    if (cell.find_first_of("eE") != cell.npos)
      return fmt::format("a spreadsheet rounded them: '{}'", cell);
  if (std::count(cell.begin(), cell.end(), ':') == 1 && cell.size() < 10)
    return fmt::format("a spreadsheet cut the hours off: '{}'", cell);
  return fmt::format("'{}' is no time stamp plumb knows", cell);
}

/// The times of a column in one order of day and month; none if one of them has none.
struct Times {
  std::vector<double> all;
  bool fit = true;

  void add(const std::optional<double>& t) {
    fit = fit && t.has_value();
    if (fit)
      all.push_back(*t);
    else
      all.clear();
  }
};

/// A column whose cells have one format.
struct ColumnTimes {
  std::string format;
  bool either = false;
  Times day_first, month_first;  // the latter only if `either`
};

bool same_steps(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs((a[i] - a[0]) - (b[i] - b[0])) > 1e-3) return false;
  return true;
}

/// The times, with day and month in the order that the whole column shows. If it shows none,
/// `out.undecided` is set.
std::vector<double> decided(ColumnTimes column, DateOrder wished, Timestamps& out) {
  auto &day_first = column.day_first.all, &month_first = column.month_first.all;
  if (!column.either) return std::move(day_first);
  const char separator = column.format.front();
  const auto named = [&](DateOrder order) {
    const bool day = order == DateOrder::kDayFirst;
    out.format = fmt::format("{1}{0}{2}{0}YYYY{3}", separator, day ? "DD" : "MM", day ? "MM" : "DD",
                             column.format.substr(1));
    return std::move(day ? day_first : month_first);
  };
  if (wished != DateOrder::kUnknown) return named(wished);
  if (!day_first.empty() && (month_first.empty() || separator == '.'))
    return named(DateOrder::kDayFirst);
  if (day_first.empty() && !month_first.empty()) return named(DateOrder::kMonthFirst);
  if (day_first.empty()) return {};
  if (same_steps(day_first, month_first)) return named(DateOrder::kDayFirst);
  out.undecided = true;
  out.format = fmt::format("DD{0}MM or MM{0}DD", separator);
  return {};
}

}  // namespace

Timestamps read_timestamps(const CellColumn& cells, char decimal, DateOrder order) {
  Timestamps out;
  ColumnTimes column;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto time = cell_time(cells[i], decimal);
    if (i == 0 && time) column.format = time->format, column.either = time->either;
    if (!time || column.format != time->format) {
      out.damage =
          time ? fmt::format("the format changes from {} to {}", column.format, time->format)
               : damage_of(cells[i]);
      out.damaged_row = i;
      return out;
    }
    column.day_first.add(time->day_first);
    if (column.either) column.month_first.add(time->month_first);
  }
  if (cells.empty()) return out;
  out.format = column.format;
  out.seconds = decided(std::move(column), order, out);
  if (out.seconds.empty()) {
    if (!out.undecided) out.damage = "no order of day and month fits all of them";
    return out;
  }
  const auto [low, high] = std::minmax_element(out.seconds.begin(), out.seconds.end());
  const bool all_the_same = *low == *high;
  if (out.format == "spreadsheet days" && *high - *low > kMostDays * kDay_s) {
    out.damage = "as days of a spreadsheet they would last years";
    out.seconds.clear();
    return out;
  }
  double day = 0.0;
  for (std::size_t i = 1; out.format == "clock" && i < out.seconds.size(); ++i) {
    out.seconds[i] += day;
    if (out.seconds[i] >= out.seconds[i - 1] - 0.5 * kDay_s) continue;
    day += kDay_s;
    out.seconds[i] += kDay_s;
    out.wrapped = true;
  }
  if (out.seconds.size() > 2 && all_the_same) {
    out.damage = "all are the same";
    out.seconds.clear();
    return out;
  }
  out.first = out.seconds.front();
  for (double& t : out.seconds) t -= out.first;
  return out;
}

}  // namespace plumb::offline
