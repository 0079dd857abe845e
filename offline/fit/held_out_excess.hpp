// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "noise/noise_floor.hpp"

namespace plumb::offline {

/// What a model leaves on poses that had no say, beside what the noise makes unavoidable. fit,
/// compare and diagnose all ask here whether that is the noise floor or a lack of fit, so that they
/// agree.
struct HeldOutExcess {
  enum class Level {
    kAtTheFloor,         // up to 1.3 noise floors: nothing is left to explain
    kAsFewPosesLeaveIt,  // more, but no more than so few poses leave to a model that is right
    kAsScatterLeavesIt,  // more, but no more than the joints would leave if what a diagnosis sees
                         // in the residuals is their scatter: inferred, not measured
    kLackOfFit           // clearly more: something is missing, named or not
  };

  double times = 0.0;        // noise floors
  double unavoidable = 1.0;  // unavoidable_ratio of the fit
  double inferred = 1.0;     // noise floors that the scatter of the joints would make

  Level level() const;
  bool lack_of_fit() const { return level() == Level::kLackOfFit; }
  /// Whether the poses are so few that this makes itself felt at all.
  bool few_poses() const;
};

/// Nothing without a noise floor.
///
/// @param mean_m       Mean 3-D error of the poses that had no say, gross outliers left out [m].
/// @param unavoidable  unavoidable_ratio of the fit.
std::optional<HeldOutExcess> held_out_excess(double mean_m, const NoiseFloor& floor,
                                             double unavoidable);

}  // namespace plumb::offline
