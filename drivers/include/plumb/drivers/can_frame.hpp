// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plumb::drivers {

/// A data frame of a CAN bus; remote and error frames are not represented.
struct CanFrame {
  static constexpr std::size_t kMostBytes = 64;  // 8 in a classic frame

  enum class Format : std::uint8_t { kClassic, kFd };
  enum class Id : std::uint8_t { kStandard, kExtended };  // 11 or 29 bits

  std::uint32_t id = 0;
  Id id_kind = Id::kStandard;
  Format format = Format::kClassic;
  std::uint8_t length = 0;   // bytes of data: 0 .. 8, in FD also 12, 16, 20, 24, 32, 48, 64
  std::int64_t time_ns = 0;  // time of reception, CLOCK_MONOTONIC
  std::array<std::uint8_t, kMostBytes> data{};
};

}  // namespace plumb::drivers
