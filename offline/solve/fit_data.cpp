// SPDX-License-Identifier: Apache-2.0
#include "solve/fit_data.hpp"

namespace plumb::offline {

int FitData::per_pose() const {
  int axes = sigma_rad > 0.0 ? 3 : 0;
  for (bool has : measured->has_axis) axes += has ? 1 : 0;
  return axes;
}

int FitData::residual_count() const { return static_cast<int>(rows.size()) * per_pose(); }

}  // namespace plumb::offline
