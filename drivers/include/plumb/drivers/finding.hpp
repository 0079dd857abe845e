// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace plumb::drivers {

enum class Grant : std::uint8_t { kGranted, kDenied, kSkipped };

/// "granted", "denied", "skipped".
const char* to_string(Grant grant) noexcept;

/// One thing that was requested of the machine, and the result, in words.
struct Finding {
  std::string what = {};
  Grant grant = Grant::kSkipped;
  std::string why = {};     // what was found; for a denial, the system's own reason
  std::string remedy = {};  // one line that can be pasted into a shell; empty if nothing to do
};

}  // namespace plumb::drivers
