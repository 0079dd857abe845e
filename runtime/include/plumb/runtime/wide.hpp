// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace plumb {

/// A constant as often as the widest register has lanes: it multiplies one as it stands.
struct alignas(32) Wide {
  constexpr Wide() = default;
  constexpr explicit Wide(double x) : copies{x, x, x, x} {}

  std::array<double, 4> copies{};
};

/// A point so.
struct WidePoint {
  Wide x, y, z;
};

}  // namespace plumb
