// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/cases/blind_case.hpp"

namespace plumb::offline {

/// An arm with these effects, measured at so many poses; nothing is asked of fresh ones.
inline BlindRequest hiding(const std::vector<std::string>& effects, int poses,
                           std::uint64_t seed = 1) {
  BlindRequest out;
  out.poses = poses;
  out.fresh_poses = 1;
  out.effects = effects;
  out.seed = seed;
  return out;
}

inline bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace plumb::offline
