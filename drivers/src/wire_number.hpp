// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "plumb/drivers/bus_layout.hpp"

namespace plumb::drivers {

/// The most negative integer of 1 to 4 bytes, which stands for "not a number".
constexpr std::int32_t not_a_number(int bytes) noexcept {
  // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): 1 to 4 bytes
  return static_cast<std::int32_t>(-(std::int64_t{1} << (8 * bytes - 1)));
}

/// `value` in counts, rounded to the nearest integer and clamped to a range that is symmetric about
/// 0.
inline std::int32_t to_counts(double value, double scale, int bytes) noexcept {
  if (std::isnan(value)) return not_a_number(bytes);
  const double most = -(static_cast<double>(not_a_number(bytes)) + 1.0);
  return static_cast<std::int32_t>(std::clamp(std::round(value / scale), -most, most));
}

inline double from_counts(std::int32_t counts, double scale, int bytes) noexcept {
  if (counts == not_a_number(bytes)) return std::numeric_limits<double>::quiet_NaN();
  return counts * scale;
}

/// Writes the lower `bytes` bytes of a number, 1 to 4 of them, in this byte order.
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

/// Reads a signed number of 1 to 4 bytes.
inline std::int32_t get_signed(const std::uint8_t* at, int bytes, ByteOrder order) noexcept {
  const int unused = 32 - 8 * bytes;
  // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): unused is 0 to 24
  return static_cast<std::int32_t>(get(at, bytes, order) << unused) >> unused;
}

}  // namespace plumb::drivers
