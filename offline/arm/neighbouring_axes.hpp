// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// Neighbouring axes at a smaller angle are nearly parallel: Hayati's beta replaces d, which would
/// be ill-conditioned. Chosen: 3 degrees, far above the errors of an arm.
inline constexpr double kNearParallel_rad = 0.05;

/// The row whose link connects joint i and joint i + 1.
inline int link_row(const format::Chain& chain, int joint) {
  return chain.convention == format::Convention::kStandard ? joint : joint + 1;
}

/// Whether the axes of joint i and joint i + 1 are nearly parallel in the table.
inline bool near_parallel(const format::Chain& chain, int joint) {
  return std::abs(std::sin(chain.joints[link_row(chain, joint)].alpha)) < kNearParallel_rad;
}

}  // namespace plumb::offline
