// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace plumb::drivers {

enum class Grant : std::uint8_t { kGranted, kDenied, kSkipped };

/// "granted", "denied", "skipped".
const char* to_string(Grant grant) noexcept;

/// One thing that was asked of the machine, in words.
struct Finding {
  std::string what = {};
  Grant grant = Grant::kSkipped;
  std::string why = {};     // what was seen; for a denial, the system's own reason
  std::string remedy = {};  // one line that can be pasted; empty if nothing is to be done
};

}  // namespace plumb::drivers
