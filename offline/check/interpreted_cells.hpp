// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "check/convention.hpp"

namespace plumb::offline {

/// The cell as conventions mean it, each parsed once: parsing costs more than placing the arm.
/// Joint directions, mirrors, the unit of turning joints and couplings stay as labelled, because
/// they are applied to the measurements.
class InterpretedCells {
 public:
  InterpretedCells(const Cell& cell, const Convention& labels) : cell_(cell), labels_(labels) {}

  /// Valid as long as this object.
  const Cell& as(Convention c);

 private:
  const Cell& cell_;
  const Convention& labels_;
  std::map<std::string, Cell> cells_;
};

}  // namespace plumb::offline
