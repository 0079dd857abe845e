// SPDX-License-Identifier: Apache-2.0
#include "noise/stated_touch.hpp"

#include <algorithm>

namespace plumb::offline {

std::optional<double> sigma_of_touches(const Cell& cell, const Measurements& measured) {
  const MeasurementSettings& m = cell.measurement;
  const bool alone = std::all_of(measured.placement.begin(), measured.placement.end(),
                                 [](int placement) { return placement >= 0; });
  return m.sigma_touch_m || !alone ? m.sigma_touch_m : m.sigma_m;
}

}  // namespace plumb::offline
