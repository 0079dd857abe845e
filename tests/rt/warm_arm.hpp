// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/rt/one_arm.hpp"

namespace plumb::tests {

/// one_arm() with one effect of thermal growth of joint 2 for each of these temperature sensors.
inline format::Model warm_arm(std::vector<std::string> sensors) {
  format::Model out = one_arm();
  for (auto& name : sensors)
    out.effects.push_back({.name = "thermal_growth",
                           .version = 1,
                           .joints = {1},
                           .parameters = {1e-5, 0.0, 0.0},
                           .context = {{format::ContextInput::kTemperature, std::move(name), 20.0}},
                           .constants = {20.0}});
  return out;
}

}  // namespace plumb::tests
