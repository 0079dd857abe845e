// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "check/common_scale.hpp"
#include "fit/calibration.hpp"

namespace plumb::offline {

/// What is known of the errors whose cause is looked for.
struct LargeErrors {
  const ArmState& placed;                  // the state that leaves them
  const Calibration* fit = nullptr;        // what it comes from; null: nothing could be fitted
  const std::optional<GrossScale>& scale;  // explains that no interpretation fits
  bool otherwise_meant = false;            // the files are meant otherwise than labelled
  bool setups_moved = false;               // W-CHECK-SAME has said that something moved
};

/// A cause of large errors in the measurements, with the findings that name it.
struct ErrorCause {
  std::string words;  // empty: none was found
  std::vector<Problem> findings;
  bool explains_outliers = false;  // they are a part of it or all
  std::string moved;               // what moved, if that is the cause
};

/// The first of these that is found: rows with one common fault such as another unit, one factor on
/// all points, a moment at which tracker, base or tool moved, a pattern that repeats from row to
/// row (which is told but explains no large error), a part that contradicts the rest. The pattern
/// goes before the part, because it says more about the cause.
ErrorCause error_cause(const Cell& cell, const MeasurementFiles& measured,
                       const std::vector<int>& rows, const LargeErrors& errors);

}  // namespace plumb::offline
