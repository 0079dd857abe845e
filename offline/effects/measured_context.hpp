// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "plumb/runtime/context.hpp"

namespace plumb::offline {

/// What is known about a measured pose: what the runtime knows in a control cycle too, and what
/// follows from the order of measuring and from the position of the tracker. Suffix _B: base frame.
struct MeasuredContext {
  Context known;  // what the runtime knows too

  double order = kUnknown;  // index in the series, 0, 1, …
  /// Last move of each joint, as a share of the largest move of all joints, -1 .. 1.
  std::array<double, format::kMaxJoints> step = Context::unknown();
  std::array<double, 3> tracker_B{kUnknown, kUnknown, kUnknown};  // origin of the tracker [m]
  std::array<double, 3> tracker_up_B{0.0, 0.0, 1.0};              // its vertical axis, unit vector
};

}  // namespace plumb::offline
