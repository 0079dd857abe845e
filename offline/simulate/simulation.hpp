// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cell/measurements.hpp"
#include "simulate/hidden_effect.hpp"

namespace plumb::offline {

/// The motion of the measured points that one hidden effect causes.
struct EffectSize {
  double rms_m = 0.0;      // per axis
  double visible_m = 0.0;  // per axis, after geometry was fitted to it
};

struct GrossOutlier {
  int row = 0;
  std::array<double, 3> shift_M{};  // [m]
};

struct Simulation {
  MeasurementFiles measured;           // its table contains the context columns
  std::vector<Column> context;         // time and the recorded context
  Rows3 true_p_M;                      // without noise and outliers, with scatter of joints [m]
  std::vector<HiddenEffect> effects;   // with the sizes and numbers that were used
  std::vector<EffectSize> sizes;       // of each effect
  std::vector<GrossOutlier> outliers;  // by row
  format::Chain true_chain;            // the true geometry
  format::Pose X_MB;
  format::Pose X_TG;       // reflector G in the tool frame; turned if the target is fitted
  std::string truth_json;  // every true parameter, for the scoring only
};

}  // namespace plumb::offline
