// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "noise/joint_scatter.hpp"
#include "noise/noise_floor.hpp"

namespace plumb::offline {

/// How well the joints come back to the same position: the standard deviation of a random error of
/// each joint that differs from stop to stop. No model can correct it.
struct Repeatability {
  std::vector<double> std;  // of each joint [rad or m]; 0: none is seen
  double nats = 0.0;     // evidence for scatter over noise alone, less 1 for each fitted variance
                         // [Akaike 1974]
  double sigma_m = 0.0;  // of a measured coordinate, noise and scatter together
  double usual_sigma_m = 0.0;  // the same if every joint scattered by 60 urad

  /// Whether the evidence for it exceeds odds of 20 to 1, and its size is usual.
  bool supported() const;
  /// Whether the poses scatter by no more than if every joint scattered by 60 urad, and no joint by
  /// more than 200 urad; industrial arms have 10 to 60 urad. Larger scatter is more likely an
  /// effect that the model lacks: an error that depends on a joint's angle differs from pose to
  /// pose, too.
  bool usual() const;
};

/// Mean squares of the motion of the measured coordinates by each joint and of their stated sigma.
/// Lines are those of single readings, not of stops, and may be added a part at a time.
class SquaredMotions {
 public:
  /// sigma_m: 1 sigma by which each line was divided [m], shape (lines,).
  void add(const ScatterLines& lines, const std::vector<double>& sigma_m);

  /// The repeatability with these variances. Its `nats` are not set.
  Repeatability with(const JointScatter& scatter) const;

 private:
  std::vector<double> joint_;
  double sigma_ = 0.0, lines_ = 0.0;
};

/// Estimates the repeatability from the residuals of a calibrated model at the poses it was fitted
/// to, assuming that they contain only noise and scatter of the joints. Effects that the model
/// lacks look like scatter, too.
///
/// @param fitted  The parameters of `state` that were fitted to these readings.
Repeatability repeatability(const Cell& cell, const Measurements& measured, const ArmState& state,
                            const std::vector<Parameter>& fitted, const std::vector<int>& rows);

/// The noise floor with `inferred_m` set to the floor that the repeatability of the arm implies, if
/// that is supported, larger than the floor, and the floor is known.
NoiseFloor with_repeatability(NoiseFloor floor, const Repeatability& repeatability);

/// "J3 31 urad, J2 25 urad", largest first; joints that scatter far less than the first are left
/// out.
std::string in_words(const Cell& cell, const Repeatability& repeatability);

/// Number of the stop of each of `rows`. Successive rows of the file at one pose, under the same
/// load and from the same side, were read while the arm stood still.
std::vector<int> stops(const Measurements& measured, const std::vector<int>& rows);

/// The lines of the readings of each stop added up and divided by the square root of their number.
ScatterLines by_stop(const ScatterLines& lines, const std::vector<int>& stops);

}  // namespace plumb::offline
