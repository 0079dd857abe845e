// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "plumb/format/limits.hpp"

namespace plumb::offline {

/// The walls of a cell along each normalised input; initially those of the whole box.
struct Walls {
  std::array<double, format::kMaxJoints> low, high;
  Walls() {
    low.fill(-1.0);
    high.fill(1.0);
  }
};

}  // namespace plumb::offline
