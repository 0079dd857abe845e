// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/transform.hpp"
#include "simulate/arm.hpp"

namespace plumb::offline::twin {

/// The same pose in the words of the bus and of the simulator.
inline Transformd to_transform(const sim::Isometry3d& X) { return {X.linear(), X.translation()}; }

inline sim::Isometry3d to_isometry(const Transformd& X) {
  sim::Isometry3d out = sim::Isometry3d::Identity();
  out.linear() = X.R;
  out.translation() = X.p;
  return out;
}

}  // namespace plumb::offline::twin
