// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/rt/one_arm.hpp"

namespace plumb::tests {

/// The arm growing by each of these temperatures.
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
