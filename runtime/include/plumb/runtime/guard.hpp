// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "plumb/format/model.hpp"
#include "plumb/runtime/corrector.hpp"

namespace plumb {

/// Monotone counters of a guard; read them from the thread that steps it.
/// A step counts as one of held, stale, refused and limited at most, in this order.
struct GuardCounters {
  std::uint64_t steps = 0;
  std::uint64_t refused = 0;
  std::uint64_t limited = 0;
  std::uint64_t held = 0;   // a target that was not finite: the last output stood
  std::uint64_t stale = 0;  // ramping out, or out, because nothing fresh arrived
  std::uint64_t swaps = 0;  // limits taken over from another model
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
/// c is the difference of the positions [m] and the rotation vector of R_c R_d^T [rad], both in
/// the base frame; a cell that corrects positions only leaves the rotation alone.
/// A refusal is no step either: the last correction decays to zero at the slew limit on top of the
/// present target. A target that is not finite, or no rotation, holds the last output; a correction
/// that is not finite counts as refused.
///
/// The ramp runs 0 .. 1 over ramp_s of valid cycles, smoothly, and back while refused, stale or
/// off. Status: kStale, else a refusal passes through, else kLimited, kRamping, or what the
/// correction says.
///
/// Another model needs no blending: what is applied is kept, so the difference of the two models
/// is what the next steps make up for at the slew limit, and only one model is ever evaluated.
/// A correction beyond the new size limit shrinks to it at the same pace.
///
/// Heap: none. Thread: one. Cost: fixed. Errors: by status only; whatever comes in, no output
/// steps.
class Guard {
 public:
  explicit Guard(const format::GuardLimits& limits) noexcept;

  /// Whether target and joint state are recent enough to go by (class Age knows).
  enum class Inputs : std::uint8_t { kFresh, kStale };

  /// Once a cycle. dt: time since the last step [s]; not finite or negative counts as 0, and more
  /// than two cycles as two.
  GuardOutput step(const Transformd& X_BD, const Correction& correction, double dt_s,
                   Inputs inputs = Inputs::kFresh) noexcept;

  /// Another model of the same robot speaks from the next step on: under its limits.
  void swap(const format::GuardLimits& limits) noexcept;

  /// From now on the correction ramps out to zero (kOff) or back in.
  enum class Enable : std::uint8_t { kOff, kOn };
  void enable(Enable on) noexcept { enabled_ = on; }

  const GuardCounters& counters() const noexcept { return counters_; }

 private:
  /// Three numbers, and one that means nothing: read and written as one register.
  using Three = std::array<double, 4>;
  struct Offset {
    Three translation{};  // [m], base frame
    Three rotation{};     // rotation vector [rad], base frame
  };
  struct Goal;

  /// A step that turns nothing is made without what only turns need: no call, so no frame.
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
  Offset applied_;     // the correction now on top of the target
  double ramp_ = 0.0;  // 0 .. 1
  Enable enabled_ = Enable::kOn;
  Transformd last_;
  bool has_output_ = false;
  GuardCounters counters_;
};

}  // namespace plumb
