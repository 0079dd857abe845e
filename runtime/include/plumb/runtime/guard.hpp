// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "plumb/format/model.hpp"
#include "plumb/runtime/corrector.hpp"
#include "plumb/runtime/detail/kept_pose.hpp"

namespace plumb {

/// Counters of a guard, which only grow; read them from the thread that steps it.
/// A step counts as at most one of held, stale, refused and limited: the first that applies.
struct GuardCounters {
  std::uint64_t steps = 0;
  std::uint64_t refused = 0;
  std::uint64_t limited = 0;
  std::uint64_t held = 0;   // the target was no pose, so the last output was repeated
  std::uint64_t stale = 0;  // no fresh input arrived: the correction ramps out, or is out
  std::uint64_t swaps = 0;  // another model, and with it its limits, was taken over
};

/// The output to the robot controller in this cycle. Always finite.
struct GuardOutput {
  Transformd X_BC;
  bool has_output = false;  // false until the first valid cycle; nothing may be sent before
  Status status = Status::kNoModel;
};

/// Keeps the correction small, slow and continuous. The guard holds the only state of the
/// correction between cycles.
///
/// All limits (size, slew, ramp-in) act on the correction c = x_c - x_d, never on the target.
/// c is the difference of the positions [m] and the rotation vector of R_c R_d^T [rad], both in
/// the base frame; a cell that corrects positions only leaves the rotation alone.
/// A refusal does not make the output jump: the last correction decays to zero at the slew limit,
/// on top of the present target. If the target is not finite or its matrix is no rotation, the last
/// output is held. A correction that is not finite counts as refused.
///
/// The ramp rises smoothly from 0 to 1 over ramp_s of valid cycles, and falls while the input is
/// refused or stale or the guard is off. The status is the first that applies of kStale, the status
/// of a refusal, kLimited, kRamping, and the status of the correction.
///
/// When the model is swapped, the applied correction is kept. The next steps move from it to the
/// correction of the new model at the slew limit, so only one model is ever evaluated. A correction
/// beyond the new size limit shrinks to it at the same rate.
///
/// Heap: none. Thread: one. Cost: fixed. Errors: by status only; the output never jumps, whatever
/// the input is.
class Guard {
 public:
  explicit Guard(const format::GuardLimits& limits) noexcept;

  /// Whether target and joint state are recent enough to be used; class Age decides it.
  enum class Inputs : std::uint8_t { kFresh, kStale };

  /// To be called once a cycle. dt_s: time since the last step [s]; a negative number or NaN counts
  /// as 0, and more than two cycles count as two.
  GuardOutput step(const Transformd& X_BD, const Correction& correction, double dt_s,
                   Inputs inputs = Inputs::kFresh) noexcept;

  /// Takes over the limits of another model of the same robot, from the next step on.
  void swap(const format::GuardLimits& limits) noexcept;

  /// From now on the correction ramps out to zero (kOff) or in again (kOn).
  enum class Enable : std::uint8_t { kOff, kOn };
  void enable(Enable on) noexcept { enabled_ = on; }

  const GuardCounters& counters() const noexcept { return counters_; }

 private:
  /// Three numbers and an arbitrary fourth, so that they are read and written as one register.
  using Three = std::array<double, 4>;
  struct Offset {
    Three translation{};  // [m], base frame
    Three rotation{};     // rotation vector [rad], base frame
  };
  struct Goal;

  /// The step is compiled twice. The version for positions only contains no code for rotations and
  /// thus makes no calls and needs no stack frame.
  enum class Moves : std::uint8_t { kPosition, kPose };

  double elapsed(double dt_s) const noexcept;
  template <Moves kMoves>
  Status judge(const Transformd& X_BD, const Correction& correction) const noexcept;
  Status heard(Status said, Inputs inputs) noexcept;
  template <Moves kMoves>
  Goal wanted(const Transformd& X_BD, const Transformd& X_BC) const noexcept;
  void ramp_towards(double goal, double dt) noexcept;
  template <Moves kMoves>
  bool approach(const Goal& goal, double dt) noexcept;
  bool turns() const noexcept;
  template <Moves kMoves>
  GuardOutput applied_to(const Transformd& X_BD, Status status) noexcept;
  template <Moves kMoves>
  GuardOutput step_of(const Transformd& X_BD, const Correction& correction, double dt_s,
                      Inputs inputs) noexcept;

  format::GuardLimits limits_;
  Offset applied_;     // the correction that is now added to the target
  double ramp_ = 0.0;  // 0 .. 1
  Enable enabled_ = Enable::kOn;
  KeptPose last_;
  bool has_output_ = false;
  GuardCounters counters_;
};

}  // namespace plumb
