// SPDX-License-Identifier: Apache-2.0
#include "rt/utc.hpp"

#include <fmt/format.h>
#include <time.h>

#include <chrono>
#include <string_view>

namespace plumb::drivers::rt {

std::int64_t utc_ns() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since).count();
}

std::string utc_text(std::int64_t since_1970_ms) {
  const time_t seconds = static_cast<time_t>(since_1970_ms / 1000);
  tm parts{};
  ::gmtime_r(&seconds, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", parts.tm_year + 1900,
                     parts.tm_mon + 1, parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec,
                     since_1970_ms % 1000);
}

std::string utc_second(std::int64_t since_1970_s) {
  return utc_text(1000 * since_1970_s).substr(0, 19) + "Z";
}

bool is_utc_second(const std::string& text) {
  constexpr std::string_view kForm = "0000-00-00T00:00:00Z";
  if (text.size() != kForm.size()) return false;
  for (std::size_t i = 0; i < kForm.size(); ++i)
    if (kForm[i] == '0' ? text[i] < '0' || text[i] > '9' : text[i] != kForm[i]) return false;
  const auto two = [&](std::size_t at) { return 10 * (text[at] - '0') + (text[at + 1] - '0'); };
  return two(5) >= 1 && two(5) <= 12 && two(8) >= 1 && two(8) <= 31 && two(11) <= 23 &&
         two(14) <= 59 && two(17) <= 60;
}

}  // namespace plumb::drivers::rt
