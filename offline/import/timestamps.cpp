// SPDX-License-Identifier: Apache-2.0
#include "import/timestamps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <set>

#include "import/dialect.hpp"

namespace plumb::offline {
namespace {

constexpr double kDay_s = 86400.0;

std::optional<double> at(int year, int month, int day, int hour, int minute, double second) {
  if (month < 1 || day < 1 || hour > 24 || minute > 59 || second >= 61.0) return std::nullopt;
  const auto date = std::chrono::year{year} / std::chrono::month(static_cast<unsigned>(month)) /
                    std::chrono::day(static_cast<unsigned>(day));
  if (!date.ok()) return std::nullopt;
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return static_cast<double>(days) * kDay_s + hour * 3600.0 + minute * 60.0 + second;
}

std::string plain(std::string_view cell) {
  std::string out(cell);
  std::replace(out.begin(), out.end(), ',', '.');
  return out;
}

struct Reading {
  double seconds;
  const char* format;
};

std::optional<Reading> dated(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double second = 0.0;
  int used = 0;
  const auto whole = [&](int fields, int wanted) {
    return fields >= wanted && used == static_cast<int>(text.size());
  };
  const auto reading = [&](const char* format) -> std::optional<Reading> {
    if (const auto t = at(year, month, day, hour, minute, second)) return Reading{*t, format};
    return std::nullopt;
  };
  if (text.size() == 14 &&
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); })) {
    if (std::sscanf(text.c_str(), "%4d%2d%2d%2d%2d%2lf", &year, &month, &day, &hour, &minute,
                    &second) == 6)
      return reading("YYYYMMDDhhmmss");
  }
  if (whole(std::sscanf(text.c_str(), "%4d-%2d-%2d%*1[T ]%2d:%2d:%lf%n", &year, &month, &day, &hour,
                        &minute, &second, &used),
            6))
    return reading("ISO 8601");
  if (whole(std::sscanf(text.c_str(), "%4d-%2d-%2d%*1[T ]%2d:%2d:%lf%*1[Z]%n", &year, &month, &day,
                        &hour, &minute, &second, &used),
            6))
    return reading("ISO 8601");
  if (whole(std::sscanf(text.c_str(), "%2d.%2d.%4d %2d:%2d:%lf%n", &day, &month, &year, &hour,
                        &minute, &second, &used),
            6))
    return reading("DD.MM.YYYY hh:mm:ss");
  return std::nullopt;
}

std::optional<Reading> clock(const std::string& text) {
  int hour = 0, minute = 0, used = 0;
  double second = 0.0;
  if (std::sscanf(text.c_str(), "%2d:%2d:%lf%n", &hour, &minute, &second, &used) == 3 &&
      used == static_cast<int>(text.size()) && hour < 24 && minute < 60)
    return Reading{hour * 3600.0 + minute * 60.0 + second, "clock"};
  return std::nullopt;
}

std::optional<Reading> read(std::string_view cell, char decimal) {
  const std::string text = plain(cell);
  if (auto found = dated(text)) return found;
  if (auto found = clock(text)) return found;
  if (const auto days = number_in(cell, decimal);
      days && *days > 20000.0 && *days < 80000.0 && cell.find_first_of("eE") == cell.npos)
    return Reading{*days * kDay_s, "spreadsheet days"};
  if (const auto seconds = number_in(cell, decimal);
      seconds && *seconds < 20000.0 && *seconds >= 0.0 && cell.find_first_of("eE") == cell.npos)
    return Reading{*seconds, "seconds"};
  return std::nullopt;
}

std::string damage_of(std::string_view cell) {
  if (cell.find_first_of("eE") != cell.npos)
    return fmt::format("a spreadsheet rounded them: '{}'", cell);
  if (std::count(cell.begin(), cell.end(), ':') == 1)
    return fmt::format("a spreadsheet cut the hours off: '{}'", cell);
  return fmt::format("'{}' is no time stamp plumb knows", cell);
}

}  // namespace

Timestamps read_timestamps(const std::vector<std::string_view>& cells, char decimal) {
  Timestamps out;
  double day = 0.0, last = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto reading = read(cells[i], decimal);
    if (!reading || (i > 0 && out.format != reading->format)) {
      out.damage =
          reading ? fmt::format("the format changes from {} to {}", out.format, reading->format)
                  : damage_of(cells[i]);
      out.damaged_row = i;
      out.seconds.clear();
      return out;
    }
    out.format = reading->format;
    double now = reading->seconds + day;
    if (out.format == "clock" && i > 0 && now < last - 0.5 * kDay_s) {
      day += kDay_s;
      now += kDay_s;
      out.wrapped = true;
    }
    last = now;
    out.seconds.push_back(now);
  }
  const std::set<double> distinct(out.seconds.begin(), out.seconds.end());
  if (out.seconds.size() > 2 && distinct.size() == 1) {
    out.damage = "all are the same";
    out.seconds.clear();
    return out;
  }
  const double first = out.seconds.empty() ? 0.0 : out.seconds.front();
  for (double& t : out.seconds) t -= first;
  return out;
}

}  // namespace plumb::offline
