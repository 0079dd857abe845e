// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string_view>

namespace plumb::offline::sim {

/// Random numbers that are the same on every compiler: xoshiro256++ [Blackman, Vigna 2021], seeded
/// through splitmix64, normal values by Box and Muller. The distributions of the C++ standard
/// library are not used, because they differ between implementations.
class Random {
 public:
  /// Each purpose has an independent stream, so that an additional draw in one does not change the
  /// others.
  Random(std::uint64_t seed, std::string_view purpose);

  std::uint64_t bits();
  double uniform();  // [0, 1)
  double uniform(double low, double high);
  int below(int n);                  // 0 .. n - 1
  double normal();                   // N(0, 1)
  Eigen::Vector3d direction();       // uniform on the unit sphere
  Eigen::Quaterniond orientation();  // uniform on the rotations, w >= 0

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace plumb::offline::sim
