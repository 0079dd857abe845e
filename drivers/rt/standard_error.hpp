// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace plumb::drivers::rt {

/// Writes a line, end of line included, on stderr, or nothing of it. Never waits: who reads there
/// may have stopped reading. False: it was not written, because the reader takes no more or is
/// gone.
///
/// Of a longer line than a pipe takes at once (4,096 bytes) only the beginning is written. Threads:
/// any.
bool say_at_once(std::string_view line) noexcept;

}  // namespace plumb::drivers::rt
