// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "check/convention.hpp"

namespace plumb::offline {

/// One interpretation of the files and what it leaves.
struct Interpretation {
  Convention convention;
  double changes = 0.0;   // from the labels, see `changes`
  double placed_m = 0.0;  // RMS 3-D residual with frame and target fitted
  double fitted_m = 0.0;  // and with the geometry fitted near nominal
  double size_m = 0.0;    // RMS size of the measured cloud, as interpreted

  /// The two residuals as shares of the size of the cloud; huge if it has no size.
  double placed_share() const { return share(placed_m); }
  double fitted_share() const { return share(fitted_m); }

 private:
  double share(double rms_m) const { return size_m > 0.0 ? rms_m / size_m : 1e300; }
};

}  // namespace plumb::offline
