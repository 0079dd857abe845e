// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace plumb::drivers {

/// The shortest CAN FD frame that holds `bytes`; 0 if none does.
constexpr std::uint8_t fd_length(std::size_t bytes) noexcept {
  constexpr std::uint8_t kLonger[] = {12, 16, 20, 24, 32, 48, 64};
  if (bytes <= 8) return static_cast<std::uint8_t>(bytes);
  for (const std::uint8_t length : kLonger)
    if (bytes <= length) return length;
  return 0;
}

}  // namespace plumb::drivers
