// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "cell/cell.hpp"
#include "fit/calibration.hpp"

namespace plumb::offline {

/// A cell with the effects that its model has, and the calibration that goes with it. The cell is
/// shared and constant: a whitened fit that refers to it stays valid wherever this is copied or
/// moved.
struct FittedModel {
  std::shared_ptr<const Cell> cell;
  Calibration calibration;
};

}  // namespace plumb::offline
