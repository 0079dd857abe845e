// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/calibration.hpp"

namespace plumb::offline {

enum class Refit { kFully, kNearby };  // kNearby: as calibrate_near, for models only looked at

/// The cell with these effects, refitted from a calibration. A full refit that does not converge is
/// tried once more as a nearby one. Throws as `calibrate` does.
Calibration refitted(const Cell& cell, const Measurements& measured, const std::vector<int>& fit,
                     const std::vector<EffectEntry>& effects, const Calibration& from,
                     Refit how = Refit::kFully);

}  // namespace plumb::offline
