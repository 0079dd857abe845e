// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

namespace plumb::offline {

/// Powers of m, kg, s and K; an angle in rad is a number like any other.
struct Dimension {
  std::array<double, 4> power{};

  bool none() const { return *this == Dimension{}; }
  bool operator==(const Dimension& other) const;
};

Dimension operator*(const Dimension& a, const Dimension& b);
Dimension operator/(const Dimension& a, const Dimension& b);
Dimension raised(const Dimension& a, double power);

inline constexpr Dimension kNumberOnly{};
inline constexpr Dimension kLength{{1, 0, 0, 0}};
inline constexpr Dimension kMass{{0, 1, 0, 0}};
inline constexpr Dimension kTime{{0, 0, 1, 0}};
inline constexpr Dimension kTemperature{{0, 0, 0, 1}};
inline constexpr Dimension kForce{{1, 1, -2, 0}};
inline constexpr Dimension kTorque{{2, 1, -2, 0}};

/// "1", "N m", "1/(N m)", "m^2/s": forces as N rather than kg m/s^2.
std::string text_of(const Dimension& dimension);

}  // namespace plumb::offline
