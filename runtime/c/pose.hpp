// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb.h"
#include "plumb/runtime/transform.hpp"

/// Poses of the C interface as those of the runtime, and back. No heap; any thread.
namespace plumb::c {

inline Transformd transform_of(const plumb_pose& pose) noexcept {
  Transformd X;
  for (int i = 0; i < 3; ++i) {
    X.p(i) = pose.p_m[i];
    for (int j = 0; j < 3; ++j) X.R(i, j) = pose.R[3 * i + j];
  }
  return X;
}

inline plumb_pose pose_of(const Transformd& X) noexcept {
  plumb_pose out{};
  for (int i = 0; i < 3; ++i) {
    out.p_m[i] = X.p(i);
    for (int j = 0; j < 3; ++j) out.R[3 * i + j] = X.R(i, j);
  }
  return out;
}

}  // namespace plumb::c
