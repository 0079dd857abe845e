// SPDX-License-Identifier: Apache-2.0
#include "fit/held_out_excess.hpp"

#include "fit/constants.hpp"

namespace plumb::offline {
bool HeldOutExcess::few_poses() const { return unavoidable > kFewPosesTimes; }

HeldOutExcess::Level HeldOutExcess::level() const {
  const double right = kFloorTimes * (few_poses() ? unavoidable : 1.0);
  if (times <= kFloorTimes) return Level::kAtTheFloor;
  if (times <= right) return Level::kAsFewPosesLeaveIt;
  return times <= right * inferred ? Level::kAsScatterLeavesIt : Level::kLackOfFit;
}

std::optional<HeldOutExcess> held_out_excess(double mean_m, const NoiseFloor& floor,
                                             double unavoidable) {
  if (floor.source == NoiseFloor::Source::kNone || !(floor.mean_m > 0.0)) return std::nullopt;
  return HeldOutExcess{mean_m / floor.mean_m, unavoidable, floor.inferred_times()};
}

std::optional<HeldOutExcess> held_out_excess(double mean_rad, const OrientationFloor& floor,
                                             double unavoidable) {
  if (!floor.known() || !(floor.mean_rad > 0.0)) return std::nullopt;
  return HeldOutExcess{mean_rad / floor.mean_rad, unavoidable, 1.0};
}

}  // namespace plumb::offline
