// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumb::offline::twin {

/// The time of the twin. The controller sets it once in every cycle, and the line reads it.
struct TwinTime {
  std::int64_t now_ns = 0;
  double path_s = -1.0;  // since the path began; negative before
};

}  // namespace plumb::offline::twin
