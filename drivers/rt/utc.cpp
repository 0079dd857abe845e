// SPDX-License-Identifier: Apache-2.0
#include "rt/utc.hpp"

#include <fmt/format.h>
#include <time.h>

#include <chrono>

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

}  // namespace plumb::drivers::rt
