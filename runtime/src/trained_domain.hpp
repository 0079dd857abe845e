// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "lane_choices.hpp"
#include "lanes.hpp"
#include "plumb/runtime/tree.hpp"
#include "six_joints.hpp"

/// How TrainedDomain normalises, inlined.
namespace plumb::internal {

/// Farthest of those before and of these, from the middle of the box; what is NaN is infinitely
/// far.
inline Packed farther(const Packed& at, const Packed& before) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return larger(smaller(magnitude(at), packed(kInfinity)), before);
}

inline Packed clamped_to_box(const Packed& at) {
  return smaller(larger(at, packed(-1.0)), packed(1.0));
}

/// `farthest`: in half spans from the middle, at least 1.
inline double trust(const Packed& farthest, double fade_inverse) {
  double most = farthest[0];
  for (std::size_t lane = 1; lane < kPackedLanes; ++lane) most = std::max(most, farthest[lane]);
  const Packed trusted = packed(1.0 - (most - 1.0) * fade_inverse);
  return smaller(larger(trusted, packed(0.0)), packed(1.0))[0];
}

}  // namespace plumb::internal

namespace plumb {

inline double TrainedDomain::normalise(const internal::SixJoints& q,
                                       internal::SixJoints& u) const noexcept {
  using internal::SixJoints;
  const SixJoints mid = SixJoints::constants(mid_.data());
  const SixJoints half_inverse = SixJoints::constants(half_inverse_.data());
  Packed farthest = packed(1.0);
  for (std::size_t r = 0; r < SixJoints::kRegisters; ++r) {
    const Packed at = (q.at[r] - mid.at[r]) * half_inverse.at[r];
    farthest = internal::farther(at, farthest);
    u.at[r] = internal::clamped_to_box(at);
  }
  return internal::trust(farthest, fade_inverse_);
}

}  // namespace plumb
