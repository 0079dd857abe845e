// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/drivers/bus_content.hpp"
#include "plumb/format/model.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::drivers {

/// What mode `limited` lets through.
struct ShareSettings {
  double limited_scale = 0.5;
  double limited_m = 0.5e-3;
};

/// How much of the guard's correction goes out, by the mode: nothing, a part, or all.
///
/// The share moves to that of the mode over the model's ramp, and what goes out follows at the
/// model's slew limits, so that no change of mode is a step. Once arrived, mode full is the guard's
/// correction to the bit. `limited` scales and then shortens, translation and rotation alike.
///
/// Heap: none. Thread: one. Cost: fixed.
class CorrectionShare {
 public:
  explicit CorrectionShare(const ShareSettings& settings) noexcept : settings_(settings) {}

  /// X_BD: the target; X_BG: what the guard made of it. dt_s: 0 .. two cycles. Returns X_BC.
  Transformd step(const Transformd& X_BD, const Transformd& X_BG, CorrectionMode mode,
                  const format::GuardLimits& limits, double dt_s) noexcept;

  /// Nothing goes out: what begins later begins at zero.
  void reset() noexcept { *this = CorrectionShare(settings_); }

  double translation_m() const noexcept { return translation_.norm(); }
  double rotation_rad() const noexcept { return rotation_.norm(); }
  bool at_zero() const noexcept;

 private:
  struct Goal {
    Vector3 translation;
    Vector3 rotation;
  };
  Goal goal(const Transformd& X_BD, const Transformd& X_BG) const noexcept;
  void move_share(CorrectionMode mode, double step) noexcept;

  ShareSettings settings_;
  double scale_ = 0.0;  // of the guard's correction, 0 .. 1
  double cap_ = 0.0;    // 0 .. 1: from limited_m (0) to no cap of our own (1)
  Vector3 translation_ = Vector3::Zero();
  Vector3 rotation_ = Vector3::Zero();
};

}  // namespace plumb::drivers
