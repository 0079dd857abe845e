// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "plumb/drivers/bus_layout.hpp"

namespace plumb::drivers {

/// The most negative number of `bytes` bytes: stands for "not a number".
constexpr std::int32_t not_a_number(int bytes) noexcept {
  return static_cast<std::int32_t>(-(std::int64_t{1} << (8 * bytes - 1)));
}

/// Counts of `value`, rounded; beyond the range the nearest end of it, the same on both sides.
inline std::int32_t to_counts(double value, double scale, int bytes) noexcept {
  if (std::isnan(value)) return not_a_number(bytes);
  const double most = -(static_cast<double>(not_a_number(bytes)) + 1.0);
  return static_cast<std::int32_t>(std::clamp(std::round(value / scale), -most, most));
}

inline double from_counts(std::int32_t counts, double scale, int bytes) noexcept {
  if (counts == not_a_number(bytes)) return std::numeric_limits<double>::quiet_NaN();
  return counts * scale;
}

/// The lower `bytes` bytes of a number, 1 to 4 of them.
inline void put(std::uint8_t* at, std::uint32_t bits, int bytes, ByteOrder order) noexcept {
  for (int i = 0; i < bytes; ++i)
    at[order == ByteOrder::kLittle ? i : bytes - 1 - i] = static_cast<std::uint8_t>(bits >> 8 * i);
}

inline std::uint32_t get(const std::uint8_t* at, int bytes, ByteOrder order) noexcept {
  std::uint32_t bits = 0;
  for (int i = 0; i < bytes; ++i)
    bits |= std::uint32_t{at[order == ByteOrder::kLittle ? i : bytes - 1 - i]} << 8 * i;
  return bits;
}

/// The same with its sign.
inline std::int32_t get_signed(const std::uint8_t* at, int bytes, ByteOrder order) noexcept {
  const int unused = 32 - 8 * bytes;
  return static_cast<std::int32_t>(get(at, bytes, order) << unused) >> unused;
}

}  // namespace plumb::drivers
