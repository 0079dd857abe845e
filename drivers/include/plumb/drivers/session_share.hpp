// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/drivers/bus_content.hpp"
#include "plumb/format/model.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::drivers {

/// The settings of mode `limited`: the correction is scaled, then limited to a length [m].
struct ShareSettings {
  double limited_scale = 0.5;
  double limited_m = 0.5e-3;
};

/// Sends nothing, a part or all of the guard's correction, depending on the mode.
///
/// After a change of mode the share ramps to its new value over the model's ramp time, and the
/// output follows at the model's slew limits, so that it does not jump. At the end of the ramp,
/// mode full sends the guard's correction to the bit. `limited` scales and then shortens the
/// correction, translation and rotation alike.
///
/// Heap: none. Thread: one. Cost: fixed.
class CorrectionShare {
 public:
  explicit CorrectionShare(const ShareSettings& settings) noexcept : settings_(settings) {}

  /// Returns the pose X_BC to send. X_BD: the target; X_BG: the output of the guard for it; dt_s:
  /// time since the last step, 0 .. two cycles, and after a stall the time for which the inputs had
  /// been lost.
  Transformd step(const Transformd& X_BD, const Transformd& X_BG, CorrectionMode mode,
                  const format::GuardLimits& limits, double dt_s) noexcept;

  /// Sets the output to zero, from where the next correction begins.
  void reset() noexcept { *this = CorrectionShare(settings_); }

  double translation_m() const noexcept { return Vector3(applied_.d.data()).norm(); }
  double rotation_rad() const noexcept { return Vector3(applied_.e.data()).norm(); }
  bool at_zero() const noexcept;

 private:
  struct Goal {
    Vector3 translation;
    Vector3 rotation;
  };
  Goal goal(const Transformd& X_BD, const Transformd& X_BG) const noexcept;
  void move_share(CorrectionMode mode, double step) noexcept;

  ShareSettings settings_;
  double scale_ = 0.0;     // scale of the guard's correction, 0 .. 1
  double cap_ = 0.0;       // limit of its length, from limited_m (0) to no limit (1)
  format::Twist applied_;  // the correction that is sent: translation [m], rotation vector [rad]
};

}  // namespace plumb::drivers
