// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

#include "lanes.hpp"

namespace plumb::internal {

/// Uninitialised storage for a T, all of whose numbers are written before they are read.
template <class T>
union Uninitialised {
  static_assert(std::is_trivially_destructible_v<T>);
  T value;
  Uninitialised() noexcept {}  // NOLINT: leaves the value uninitialised on purpose
  Uninitialised(const Uninitialised&) = delete;
  Uninitialised& operator=(const Uninitialised&) = delete;
};

/// Copies in whole registers. For some sizes compilers use a string instruction, whose start alone
/// costs more, for others halves of registers.
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
