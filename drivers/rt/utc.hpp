// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace plumb::drivers::rt {

/// The system's clock [ns since 1970].
std::int64_t utc_ns();

/// "2026-11-25T03:50:46.123Z".
std::string utc_text(std::int64_t since_1970_ms);

/// "2026-11-25T03:50:46Z", whose order as text is that in time.
std::string utc_second(std::int64_t since_1970_s);

/// True for a text of this form, with a month, day and time that exist on some clock.
bool is_utc_second(const std::string& text);

}  // namespace plumb::drivers::rt
