// SPDX-License-Identifier: Apache-2.0
#include "check/interpreted_cells.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumb::offline {

const Cell& InterpretedCells::as(Convention c) {
  c.reversed = labels_.reversed;
  c.mirror = Mirror::kNone;
  c.turn_unit = labels_.turn_unit;
  c.coupling = labels_.coupling;
  const auto key = fmt::format("{} {} {} {} {}", static_cast<int>(c.dh), c.length_unit,
                               c.angle_unit, fmt::join(c.quarter_turns, ","), c.frame_inverted) +
                   fmt::format(" {}", fmt::join(c.zero, ","));
  auto found = cells_.find(key);
  if (found == cells_.end()) found = cells_.emplace(key, read_as(cell_, labels_, c)).first;
  return found->second;
}

}  // namespace plumb::offline
