// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>

namespace plumb::tests {

/// How one sleep ends.
struct SleepEnd {
  std::int64_t late_ns = 0;  // after the time asked for; negative: before
  int error = 0;
};

/// Time that passes only as a test says.
struct Script {
  std::int64_t now_ns = 1'000'000'000;
  std::deque<SleepEnd> sleeps = {};  // then on time
  int slept = 0;
};

/// A time source that plays a script.
struct ScriptedTime {
  Script* script;

  std::int64_t now_ns() noexcept { return script->now_ns; }
  int sleep_until_ns(std::int64_t time_ns) noexcept {
    ++script->slept;
    SleepEnd end;
    if (!script->sleeps.empty()) {
      end = script->sleeps.front();
      script->sleeps.pop_front();
    }
    script->now_ns = time_ns + end.late_ns;
    return end.error;
  }
};

}  // namespace plumb::tests
