// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/transform.hpp"
#include "simulate/arm.hpp"

namespace plumb::offline::twin {

/// Converts a pose of the simulator to the type that the bus uses.
inline Transformd to_transform(const sim::Isometry3d& X) { return {X.linear(), X.translation()}; }

inline sim::Isometry3d to_isometry(const Transformd& X) {
  sim::Isometry3d out = sim::Isometry3d::Identity();
  out.linear() = X.R;
  out.translation() = X.p;
  return out;
}

}  // namespace plumb::offline::twin
