// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "plumb/runtime/context_inputs.hpp"
#include "plumb/runtime/detail/age.hpp"
#include "plumb/runtime/detail/kept_pose.hpp"
#include "plumb/runtime/detail/last_move.hpp"
#include "plumb/runtime/guard.hpp"
#include "plumb/runtime/model_slot.hpp"

namespace plumb {

/// How long the cycle may use its last inputs, and when a joint counts as moved.
struct CycleSettings {
  double target_limit_s = 0.1;  // longest age of a target: twelve lost frames of a 125 Hz bus
  double joints_limit_s = 0.1;  // longest age of joint positions
  ContextLimits context = {};
  double dead_band = 5e-4;  // of LastMove [rad]; for prismatic joints times length_scale_m
};

enum class Arrival : std::uint8_t { kNothingNew, kArrived };

/// The inputs that arrived since the last cycle. Members that did not arrive are not read; the
/// previous value stays valid.
struct CycleInput {
  std::int64_t now_ns = 0;  // time on any clock that advances; jumps do no harm
  Arrival target = Arrival::kNothingNew;
  Transformd X_BD = {};  // desired tool pose, base frame [m]
  Arrival joints = Arrival::kNothingNew;
  std::array<double, kMaxJoints> q_measured = Context::unknown();   // [rad] or [m]; NaN: unknown
  std::array<double, kMaxJoints> q_commanded = Context::unknown();  // for X_BD; NaN: not given
  ContextReadings context = {};
};

struct CycleOutput {
  GuardOutput output;     // to be sent to the robot controller
  Correction correction;  // result of the inverse, before the guard
};

/// The whole state of the cycle in one object of known size.
///
/// One step takes the model from the slot, ages the inputs, solves once and applies the guard.
///   seed       the commanded joints if they arrived, else the last solution, else the measured
///              joints. A refused step discards the last solution, so that the next solve starts
///              where the arm really is
///   direction  of motion: from the commanded joints if they arrived, else from the measured ones
///   stale      no valid target, or no valid joint state, has arrived for longer than its limit.
///              The correction ramps out on top of the last target, with status kStale, and ramps
///              in again when the input returns
///   bad target one that arrives but is no pose: the last output is held, and the target does not
///              count as fresh
///   joints     of inputs and outputs are the controller's values; inside they are the joint angles
///              that follow by the model's coupling
///   new model  taken from the slot at the beginning of the step; the guard blends it in
///
/// Heap: none. Thread: one; the loader of the slot may run at the same time. Cost: fixed for a
/// given model. Errors: by status only; the output is finite whatever the bits of the input are.
class Cycle {
 public:
  /// The slot must outlive the cycle.
  explicit Cycle(ModelSlot& slot, const CycleSettings& settings = {}) noexcept;

  /// Runs one cycle with the inputs that have arrived since the last one. To be called once in
  /// every cycle, also if nothing has arrived.
  CycleOutput step(const CycleInput& input) noexcept;

  /// From the next step on the correction ramps out to zero (kOff) or back in.
  void enable(Guard::Enable on) noexcept { guard_.enable(on); }

  /// State after the last step; to be read from the thread that steps.
  const GuardCounters& counters() const noexcept { return guard_.counters(); }
  const Context& context() const noexcept { return context_; }
  const LoadedModel& model() const noexcept { return *model_; }
  /// Time since the last valid target and the last valid joint positions arrived [s].
  double target_age_s() const noexcept { return target_age_.value_s(); }
  double joints_age_s() const noexcept { return joints_age_.value_s(); }

  /// For a cycle that was copied byte by byte from another program, with the model of `slot` at
  /// work: from now on it takes its models from this slot.
  void rebind(ModelSlot& slot) noexcept {
    slot_ = &slot;
    model_ = &slot.take();
  }

 private:
  using Joints = std::array<double, kMaxJoints>;
  struct Seed {
    std::span<const double> q;
    SeedKind kind;
  };

  void take_model() noexcept;
  void hear_joints(const CycleInput& input) noexcept;
  Transformd hear_target(const CycleInput& input) noexcept;
  bool sound(const Joints& q) const noexcept;
  Joints angles(Joints values) const noexcept;
  void follow_moves() noexcept;
  Seed seed() const noexcept;
  void remember(const Transformd& X_BD, const Correction& correction) noexcept;
  Guard::Inputs freshness() const noexcept;
  std::size_t joints() const noexcept;

  ModelSlot* slot_;
  const LoadedModel* model_;
  CycleSettings settings_;
  Guard guard_;
  ContextInputs inputs_;
  LastMove move_;
  Context context_;
  CycleTime time_;
  Age target_age_;
  Age joints_age_;
  KeptPose X_BD_;  // the last valid target
  Joints q_measured_ = Context::unknown();
  Joints q_commanded_ = Context::unknown();
  Joints q_solution_{};
  bool has_solution_ = false;
  SeedKind move_source_ = SeedKind::kMeasured;
};

static_assert(sizeof(Cycle) <= 2048);
static_assert(std::is_trivially_copyable_v<Cycle>);

}  // namespace plumb
