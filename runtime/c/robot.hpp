// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "plumb.h"
#include "plumb/robot.hpp"

/// What stands behind the opaque pointer.
struct plumb_robot {
  static constexpr std::uint64_t kMark = 0x31304d554c503a29;

  std::uint64_t mark = kMark;  // tells a robot from other aligned memory
  std::unique_ptr<plumb::Robot> robot;

  // Any thread; never change.
  int joints = 0;
  std::string serial;
  std::array<std::string, PLUMB_MAX_TEMPERATURES> sensors;
  int sensor_count = 0;
};
