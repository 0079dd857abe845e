// SPDX-License-Identifier: Apache-2.0
#include "bench/cache_sweep.hpp"

namespace plumb::offline::bench {

void CacheSweep::sweep() noexcept {
  for (Line& line : lines_) {
    volatile unsigned& touched = line.touched;
    touched = touched + 1;
  }
}

}  // namespace plumb::offline::bench
