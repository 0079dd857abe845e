// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "lane_order.hpp"
#include "plumb/runtime/detail/kept_pose.hpp"

/// Loads and stores of poses in whole registers.
namespace plumb {

/// The twelve numbers of a pose: its three axes, then its origin.
inline const double* numbers(const Transformd& X_AB) {
  static_assert(sizeof(Transformd) == 12 * sizeof(double) && offsetof(Transformd, p) == 72);
  return reinterpret_cast<const double*>(&X_AB);
}
inline double* numbers(Transformd& X_AB) { return reinterpret_cast<double*>(&X_AB); }

/// Axis j of B in A: column j of the rotation. The fourth lane is arbitrary.
inline Lanes axis(const Transformd& X_AB, std::size_t j) { return lanes(numbers(X_AB) + 3 * j); }

/// The origin of B in A. The fourth lane is arbitrary.
inline Lanes origin(const Transformd& X_AB) { return last_three(lanes(numbers(X_AB) + 8)); }

/// Copies in whole registers; all are read before the first is written.
inline void copy(const Transformd& from, KeptPose& to) {
  const double* in = numbers(from);
  const Lanes begin = lanes(in), middle = lanes(in + 4), end = lanes(in + 8);
  store(begin, to.numbers());
  store(middle, to.numbers() + 4);
  store(end, to.numbers() + 8);
}

/// X_AB with its origin moved by d, given in A.
inline Transformd moved(const Transformd& X_AB, const Lanes& d) {
  const double* in = numbers(X_AB);
  const Lanes begin = lanes(in), middle = lanes(in + 4), end = lanes(in + 8), sum = end + to_end(d);
  Transformd out;
  store(begin, numbers(out));
  store(middle, numbers(out) + 4);
  store(Lanes{end[0], sum[1], sum[2], sum[3]}, numbers(out) + 8);
  return out;
}

}  // namespace plumb
