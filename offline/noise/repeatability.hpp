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

/// How well the joints come back to the same place: an error of each joint that is another one at
/// every stop. No model can correct it.
struct Repeatability {
  std::vector<double> std;  // of each joint [rad or m]; 0: none is seen
  double nats = 0.0;        // by which it explains the lines better than noise alone; each variance
                            // that is fitted costs one [Akaike 1974]
  double sigma_m = 0.0;     // of a measured coordinate, noise and scatter together
  double usual_sigma_m = 0.0;  // the same if every joint had 60 urad

  /// Whether the readings speak for it at odds of 20 to 1, and it is of a usual size.
  bool supported() const;
  /// Whether the poses scatter by no more than if every joint had 60 urad, and no joint by more
  /// than 200; industrial arms have 10 to 60. Beyond it something that the model lacks is the
  /// likelier cause: an error that depends on the joint's angle scatters from pose to pose as well.
  bool usual() const;
};

/// How much each joint moves the measured coordinates, and their stated sigma: sums over lines,
/// reading by reading and not stop by stop, that may be added a part at a time.
class SquaredMotions {
 public:
  /// sigma_m: 1 sigma by which each line was divided [m], shape (lines,).
  void add(const ScatterLines& lines, const std::vector<double>& sigma_m);

  /// The repeatability with such variances; its nats are not set.
  Repeatability with(const JointScatter& scatter) const;

 private:
  std::vector<double> joint_;
  double sigma_ = 0.0, lines_ = 0.0;
};

/// What a calibrated model leaves of the poses that it was fitted to, as if nothing but noise and
/// the scatter of the joints were in it. What the model lacks looks like scatter too.
///
/// @param fitted  The numbers of `state` that the readings were fitted with.
Repeatability repeatability(const Cell& cell, const Measurements& measured, const ArmState& state,
                            const std::vector<Parameter>& fitted, const std::vector<int>& rows);

/// The noise floor, and beside it what the repeatability of the arm would make of it, where that is
/// supported and the floor is known.
NoiseFloor with_repeatability(NoiseFloor floor, const Repeatability& repeatability);

/// "J2 25 urad, J3 31 urad", largest first; the small ones are left out.
std::string in_words(const Cell& cell, const Repeatability& repeatability);

/// Number of the stop of each of `rows`: those that follow each other in the file at one pose were
/// read while the arm stood still.
std::vector<int> stops(const Measurements& measured, const std::vector<int>& rows);

/// Lines of readings added stop by stop and divided by the root of their number.
ScatterLines by_stop(const ScatterLines& lines, const std::vector<int>& stops);

}  // namespace plumb::offline
