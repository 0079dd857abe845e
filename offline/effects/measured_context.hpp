// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "plumb/runtime/context.hpp"

namespace plumb::offline {

/// What is known about a measured pose: what a cycle knows too, and what follows from the order of
/// measurement and from where the tracker stood.
struct MeasuredContext {
  Context known;

  double order = kUnknown;  // index in the series, 0, 1, …
  std::array<double, format::kMaxJoints> step = Context::unknown();  // last move / largest of all
                                                                     // joints
  std::array<double, 3> tracker_B{kUnknown, kUnknown, kUnknown};     // origin of the tracker [m]
  std::array<double, 3> tracker_up_B{0.0, 0.0, 1.0};                 // its vertical axis
};

}  // namespace plumb::offline
