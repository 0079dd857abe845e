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
#include "noise/orientation_floor.hpp"
#include "tree/choice.hpp"

namespace plumb::offline {

/// What the fitted numbers are relative to: the nominal arm of the cell, or the positions that the
/// controller itself reports.
enum class Base { kArm, kController };
constexpr const char* name_of(Base base) { return base == Base::kArm ? "arm" : "controller"; }

/// One calibration with its held-out errors: the result of `plumb fit`, which a run keeps.
struct Fit {
  Calibration calibration;         // on the fit poses
  std::optional<TreeChoice> tree;  // if [effects.local_tree] is listed
  Split split;
  Base base = Base::kArm;
  Rows3 predicted_M;        // per row: out of fold if it was held out, else the final model's
  Rows3 turned_G;           // the same of orientations, turns_of_target; empty: they are not fitted
  ErrorStats nominal_held;  // of the nominal arm, frame and target fitted; same poses
  ErrorStats held;          // of the calibrated model at the held-out poses
  ErrorStats geometry_held;            // of the calibrated model without its tree
  ErrorStats turn_held;                // of orientations [rad]; n = 0 if these are not fitted
  MeasuredOrientations orientations;   // as they were judged before the fit
  std::vector<Outlier> held_outliers;  // held-out poses that stand out; `held` includes them
  ErrorStats held_without_outliers;    // of the other held-out poses
  ErrorStats fit;                      // in-sample: never accuracy
  NoiseFloor floor;
  OrientationFloor turn_floor;     // known only where orientations are fitted
  double unavoidable_ratio = 1.0;  // error of a correct model fitted to so few poses [noise floors]
  std::vector<std::string> still;  // joints that never moved
  bool size_unknown = false;       // nothing that was read tells the size of the arm
  std::vector<Problem> remarks;
};

}  // namespace plumb::offline
