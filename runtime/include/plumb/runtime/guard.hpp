// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/format/model.hpp"
#include "plumb/runtime/corrector.hpp"

namespace plumb {

/// Monotone counters of a guard; read them from the thread that steps it.
struct GuardCounters {
  std::uint64_t steps = 0;
  std::uint64_t refused = 0;
  std::uint64_t limited = 0;
  std::uint64_t held = 0;  // a target that was not finite: the last output stood
};

/// What goes to the robot controller this cycle. Always finite.
struct GuardOutput {
  Transformd X_BC;
  bool has_output = false;  // false until the first valid cycle: send nothing
  Status status = Status::kNoModel;
};

/// The only state of the cycle: keeps the correction small, slow and continuous.
///
/// All limits act on the correction c = x_c - x_d, never on the target: size, slew, ramp-in.
/// A refusal is no step either: the last correction decays to zero at the slew limit on top of the
/// present target. A target that is not finite holds the last output.
/// One thread; no allocation; fixed cost.
class Guard {
 public:
  explicit Guard(const format::GuardLimits& limits) noexcept;

  /// Once a cycle. dt: time since the last step [s]; not finite or negative counts as 0, and more
  /// than two cycles as two.
  GuardOutput step(const Transformd& X_BD, const Correction& correction, double dt_s) noexcept;

  /// From now on the correction ramps out to zero (`on` false) or back in.
  enum class Enable : std::uint8_t { kOff, kOn };
  void enable(Enable on) noexcept { enabled_ = on; }

  const GuardCounters& counters() const noexcept { return counters_; }

 private:
  format::GuardLimits limits_;
  Vector3 translation_ = Vector3::Zero();  // the correction now applied [m], base frame
  Vector3 rotation_ = Vector3::Zero();     // and as rotation vector [rad], base frame
  double ramp_ = 0.0;                      // 0 .. 1
  Enable enabled_ = Enable::kOn;
  Transformd last_;
  bool has_output_ = false;
  GuardCounters counters_;
};

}  // namespace plumb
