// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "check/convention.hpp"

namespace plumb::offline {

/// One way to read the files and what it leaves.
struct Interpretation {
  Convention convention;
  double changes = 0.0;   // from the labels, see `changes`
  double placed_m = 0.0;  // RMS 3-D residual with frame and target fitted
  double fitted_m = 0.0;  // and with the geometry fitted near nominal
  double size_m = 0.0;    // RMS size of the measured cloud, as read
};

}  // namespace plumb::offline
