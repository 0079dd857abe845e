// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace plumb::drivers::rt {

/// The system's clock [ns since 1970].
std::int64_t utc_ns();

/// "2026-11-25T03:50:46.123Z".
std::string utc_text(std::int64_t since_1970_ms);

}  // namespace plumb::drivers::rt
