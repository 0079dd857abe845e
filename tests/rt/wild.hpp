// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "plumb/runtime/transform.hpp"
#include "tests/random_numbers.hpp"

/// What a bus, a sensor or a bug can hand to the cycle.
namespace plumb::tests {

inline bool one_in(Random& random, int n) { return random.below(n) == 0; }

/// Anything that fits into a double.
inline double wild(Random& random) {
  constexpr std::array<double, 15> kValues{0.0,
                                           -0.0,
                                           1.0,
                                           -1.0,
                                           1e4,
                                           -1e5,
                                           1e308,
                                           -std::numeric_limits<double>::max(),
                                           std::numeric_limits<double>::denorm_min(),
                                           1e-310,
                                           -1e-308,
                                           std::numeric_limits<double>::epsilon(),
                                           HUGE_VAL,
                                           -HUGE_VAL,
                                           std::numeric_limits<double>::quiet_NaN()};
  if (one_in(random, 4)) return std::bit_cast<double>(random.bits());
  return kValues[static_cast<std::size_t>(random.below(static_cast<int>(kValues.size())))];
}

inline double wild_but_finite(Random& random) {
  const double x = wild(random);
  return std::isfinite(x) ? x : 1e300;
}

inline Transformd sound_pose(Random& random) {
  const auto u = [&] { return random.uniform(-2.0, 2.0); };
  return exp(format::Twist{{u(), u(), u()}, {u(), u(), u()}});
}

/// No rotation, or no numbers.
inline Transformd broken_pose(Random& random) {
  Transformd X = sound_pose(random);
  switch (random.below(5)) {
    case 0:
      X.p(random.below(3)) = one_in(random, 2) ? HUGE_VAL : std::nan("");
      break;
    case 1:
      X.R *= one_in(random, 2) ? 1.1 : -1.0;
      break;
    case 2:
      X.R.setZero();
      break;
    case 3:
      X.R(random.below(3), random.below(3)) += one_in(random, 2) ? 3.0 : 1e308;
      break;
    default:
      X.R(random.below(3), random.below(3)) = std::nan("");
  }
  return X;
}

}  // namespace plumb::tests
