// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <numbers>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::drivers {

/// How a desired target may move. Beyond it is a planner's mistake, or a damaged message that a
/// check sum let through.
struct TargetLimits {
  double speed_m_s = 2.0;
  double speed_rad_s = 2.0 * std::numbers::pi;
  double step_m = 0.05;  // from one target to the next that came
  double step_rad = 10.0 * std::numbers::pi / 180.0;
  double period_s = 0.004;  // from one target to the next that is sent
  double gap_s = 0.1;       // of silence, after which a target has none before it
};

enum class TargetVerdict : std::uint8_t {
  kAccepted,
  kRepeated,    // the counter before: said again
  kOutOfOrder,  // an earlier counter: overtaken on the way
  kNoPose,      // a value is not known, or no number
  kTooFar,      // from the one before
  kTooFast,
};

/// Judges desired targets one by one.
///
/// A target that is too far or too fast is not to be answered, but the next is judged against it: a
/// target that jumped and stays there is accepted from then on. Speed is the distance by the time
/// between two receptions, or between their counters if that is longer: targets that were held up
/// and come in a burst are not fast.
///
/// Heap: none. Thread: one. Cost: fixed.
class TargetGate {
 public:
  explicit TargetGate(const TargetLimits& limits) noexcept : limits_(limits) {}

  /// X_BD: the pose, if the verdict is one of kAccepted, kTooFar, kTooFast.
  TargetVerdict judge(const BusMessage& target, Transformd& X_BD) noexcept;

  void restart() noexcept { has_last_ = false; }

 private:
  TargetVerdict order(const BusMessage& target) const noexcept;
  double elapsed_s(const BusMessage& target) const noexcept;
  TargetVerdict motion(const Transformd& X_BD, double elapsed_s) const noexcept;

  TargetLimits limits_;
  Transformd last_;
  std::int64_t last_ns_ = 0;
  std::uint16_t last_counter_ = 0;
  bool has_last_ = false;
};

}  // namespace plumb::drivers
