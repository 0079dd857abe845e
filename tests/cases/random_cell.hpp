// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cell/cell.hpp"

namespace plumb::offline {

/// A random arm of plausible shape with round nominal values, joint limits and a tool of 100 to 200
/// mm. kRevolute has 4 to 7 joints, kScara has 4, of which the third slides.
enum class ArmKind { kRevolute, kScara };
Cell random_cell(std::uint64_t seed, int joints, format::Convention convention, ArmKind kind);

}  // namespace plumb::offline
