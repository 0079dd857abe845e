// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

#include "lanes.hpp"

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

/// A copy by whole registers. For some sizes compilers take a string instruction instead, whose
/// start alone costs more, for others halves of registers.
template <class T>
void copy(const T& from, T& to) noexcept {
  static_assert(std::is_trivially_copyable_v<T>);
  constexpr std::size_t kRegister = sizeof(Packed), kWhole = sizeof(T) / kRegister * kRegister;
  const auto* const in = reinterpret_cast<const std::byte*>(&from);
  auto* const out = reinterpret_cast<std::byte*>(&to);
#pragma GCC unroll 32
  for (std::size_t i = 0; i < kWhole; i += kRegister) {
    Packed part;
    std::memcpy(&part, in + i, sizeof part);
    std::memcpy(out + i, &part, sizeof part);
  }
  std::memcpy(out + kWhole, in + kWhole, sizeof(T) - kWhole);
}

}  // namespace plumb::internal
