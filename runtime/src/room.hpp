// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace plumb::internal {

/// Room for a T of which no number is read before it is written: none is set beforehand.
template <class T>
union Room {
  static_assert(std::is_trivially_destructible_v<T>);
  T value;
  Room() noexcept {}  // NOLINT: that nothing is done is the point
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;
};

/// A copy by registers. For some sizes compilers take a string instruction instead, whose start
/// alone costs more.
template <class T>
void copy(const T& from, T& to) noexcept {
  static_assert(std::is_trivially_copyable_v<T>);
  constexpr std::size_t kPart = 32, kWhole = sizeof(T) / kPart * kPart;
  const auto* const in = reinterpret_cast<const std::byte*>(&from);
  auto* const out = reinterpret_cast<std::byte*>(&to);
#pragma GCC unroll 16
  for (std::size_t i = 0; i < kWhole; i += kPart) std::memcpy(out + i, in + i, kPart);
  std::memcpy(out + kWhole, in + kWhole, sizeof(T) - kWhole);
}

}  // namespace plumb::internal
