// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <numbers>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/runtime/detail/kept_pose.hpp"

namespace plumb::drivers {

/// Limits of the motion of a desired target. A target beyond them comes from a planner's mistake,
/// or from damage that the checksum did not detect.
struct TargetLimits {
  double speed_m_s = 2.0;
  double speed_rad_s = 2.0 * std::numbers::pi;
  double step_m = 0.05;  // largest step between two targets received in succession
  double step_rad = 10.0 * std::numbers::pi / 180.0;
  double period_s = 0.004;  // period at which targets are sent
  double gap_s = 0.1;       // after a longer silence a target is not compared with the previous one
};

enum class TargetVerdict : std::uint8_t {
  kAccepted,
  kRepeated,    // it has the same counter as the previous target
  kOutOfOrder,  // it has an earlier counter: it was overtaken on the way
  kNoPose,      // a value is unknown or not finite
  kTooFar,      // the step from the previous target is too large
  kTooFast,     // the motion since the previous target is too fast
};

/// Judges desired targets one by one.
///
/// A target that is too far or too fast must not be answered, but the next one is judged against
/// it: a target that jumped and stays there is accepted from then on. The speed is the distance
/// divided by the time between the receptions, or by the time between the counters if that is
/// longer, so that targets which were delayed and arrive in a burst are not taken for fast ones.
///
/// Heap: none. Thread: one. Cost: fixed.
class TargetGate {
 public:
  explicit TargetGate(const TargetLimits& limits) noexcept : limits_(limits) {}

  /// Sets X_BD to the pose of the target if the verdict is kAccepted, kTooFar or kTooFast.
  TargetVerdict judge(const BusMessage& target, Transformd& X_BD) noexcept;

  void restart() noexcept { has_last_ = false; }

 private:
  TargetVerdict order(const BusMessage& target) const noexcept;
  double elapsed_s(const BusMessage& target) const noexcept;
  TargetVerdict motion(const Transformd& X_BD, double elapsed_s) const noexcept;

  TargetLimits limits_;
  KeptPose last_;
  std::int64_t last_ns_ = 0;
  std::uint16_t last_counter_ = 0;
  bool has_last_ = false;
};

}  // namespace plumb::drivers
