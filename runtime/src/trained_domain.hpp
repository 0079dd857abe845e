// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "lane_choices.hpp"
#include "lanes.hpp"
#include "plumb/runtime/detail/trained_domain.hpp"
#include "six_joints.hpp"

/// The inline functions of TrainedDomain.
namespace plumb::internal {

/// The larger distance from the middle of the box, of `before` and |at|, lane by lane; NaN in `at`
/// counts as infinite.
inline Packed farther(const Packed& at, const Packed& before) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return larger(smaller(magnitude(at), packed(kInfinity)), before);
}

inline Packed clamped_to_box(const Packed& at) {
  return smaller(larger(at, packed(-1.0)), packed(1.0));
}

/// The weight of the trees. `farthest`: distance from the middle of the box in half spans, at
/// least 1.
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
