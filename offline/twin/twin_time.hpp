// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumb::offline::twin {

/// Time as the twin counts it; the controller sets it once a cycle, the line reads it.
struct TwinTime {
  std::int64_t now_ns = 0;
  double path_s = -1.0;  // since the path began; negative before
};

}  // namespace plumb::offline::twin
