// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "noise/noise_floor.hpp"
#include "noise/orientation_floor.hpp"

namespace plumb::offline {

/// The held-out error of a model beside the error that the noise makes unavoidable. fit, compare
/// and diagnose all use it to decide whether an error is at the noise floor or a lack of fit, so
/// that they agree.
struct HeldOutExcess {
  enum class Level {
    kAtTheFloor,         // up to 1.3 noise floors: nothing is left to explain
    kAsFewPosesLeaveIt,  // more, but no more than a correct model fitted to so few poses has
    kAsScatterLeavesIt,  // more, but no more than the scatter of the joints would cause, which a
                         // diagnosis has inferred from residuals and nobody has measured
    kLackOfFit           // clearly more: the model lacks an effect, known or not
  };

  double times = 0.0;        // the error [noise floors]
  double unavoidable = 1.0;  // unavoidable_ratio of the fit
  double inferred = 1.0;     // the error that scatter of the joints would cause [noise floors]

  Level level() const;
  bool lack_of_fit() const { return level() == Level::kLackOfFit; }
  /// Whether the poses are so few that their number noticeably raises the error.
  bool few_poses() const;
};

/// Nothing if the noise floor is unknown.
///
/// @param mean_m       Mean 3-D error of the held-out poses without gross outliers [m].
/// @param unavoidable  unavoidable_ratio of the fit.
std::optional<HeldOutExcess> held_out_excess(double mean_m, const NoiseFloor& floor,
                                             double unavoidable);

/// The same of orientations.
///
/// @param mean_rad  Mean angle between measured and predicted orientations of held-out poses [rad].
std::optional<HeldOutExcess> held_out_excess(double mean_rad, const OrientationFloor& floor,
                                             double unavoidable);

}  // namespace plumb::offline
