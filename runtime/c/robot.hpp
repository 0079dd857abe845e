// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "plumb.h"
#include "plumb/robot.hpp"

/// The definition of the opaque type of plumb.h.
struct plumb_robot {
  static constexpr std::uint64_t kMark = 0x31304d554c503a29;  // arbitrary: "):PLUM01"

  std::uint64_t mark = kMark;  // recognises a pointer that is not to a robot
  std::unique_ptr<plumb::Robot> robot;

  // These members never change and may be read from any thread.
  int joints = 0;
  std::string serial;
  std::array<std::string, PLUMB_MAX_TEMPERATURES> sensors;
  int sensor_count = 0;
};
