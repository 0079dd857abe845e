// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/measurements.hpp"
#include "fit/calibration.hpp"
#include "fit/measured_orientations.hpp"
#include "fit/split.hpp"
#include "noise/error_stats.hpp"
#include "noise/noise_floor.hpp"
#include "tree/choice.hpp"

namespace plumb::offline {

/// What the fitted numbers are added to: the nominal arm of the cell, or what the controller itself
/// says where it is.
enum class Base { kArm, kController };
constexpr const char* name_of(Base base) { return base == Base::kArm ? "arm" : "controller"; }

/// One calibration with its evidence: what `plumb fit` makes and a run keeps.
struct Fit {
  Calibration calibration;         // on the fit poses
  std::optional<TreeChoice> tree;  // if [effects.local_tree] is listed
  Split split;
  Base base = Base::kArm;
  Rows3 predicted_M;                  // per pose: by the final model, or out of fold where held out
  ErrorStats nominal_held;            // before: only frame and target fitted, same held-out poses
  ErrorStats held;                    // after
  ErrorStats geometry_held;           // geometry without the tree
  ErrorStats turn_held;               // of orientations [rad]; none if these are not fitted
  MeasuredOrientations orientations;  // as they were judged before the fit
  std::vector<Outlier> held_outliers;  // held-out poses that stand out; `held` counts them
  ErrorStats held_without_outliers;    // the second figure
  ErrorStats fit;                      // in-sample: never accuracy
  NoiseFloor floor;
  double unavoidable_ratio = 1.0;  // times the noise floor, of an arm that is right: few poses
  std::vector<std::string> still;  // joints that never moved
  std::vector<Problem> remarks;
};

}  // namespace plumb::offline
