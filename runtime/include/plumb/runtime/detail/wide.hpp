// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace plumb {

/// A constant stored in all four lanes of a register, so that it multiplies a register directly.
struct alignas(32) Wide {
  constexpr Wide() = default;
  constexpr explicit Wide(double x) : copies{x, x, x, x} {}

  std::array<double, 4> copies{};
};

/// A point whose coordinates are each stored in all four lanes.
struct WidePoint {
  Wide x, y, z;
};

}  // namespace plumb
