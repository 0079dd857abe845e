// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "plumb/runtime/age.hpp"
#include "plumb/runtime/context_inputs.hpp"
#include "plumb/runtime/guard.hpp"
#include "plumb/runtime/last_move.hpp"
#include "plumb/runtime/model_slot.hpp"

namespace plumb {

/// How long the cycle goes by what it last heard, and when a joint counts as moved.
struct CycleSettings {
  double target_limit_s = 0.1;  // twelve lost frames of a 125 Hz bus
  double joints_limit_s = 0.1;
  ContextLimits context = {};
  double dead_band = 5e-4;  // [rad]; times length_scale_m for sliding joints
};

enum class Arrival : std::uint8_t { kNothingNew, kArrived };

/// What came since the last cycle. What did not arrive is not looked at: the one before stands.
struct CycleInput {
  std::int64_t now_ns = 0;  // any clock that runs on; jumps are harmless
  Arrival target = Arrival::kNothingNew;
  Transformd X_BD = {};  // desired tool pose, base frame [m]
  Arrival joints = Arrival::kNothingNew;
  std::array<double, kMaxJoints> q_measured = Context::unknown();   // [rad] or [m]; NaN: not known
  std::array<double, kMaxJoints> q_commanded = Context::unknown();  // of X_BD; NaN: not supplied
  ContextReadings context = {};
};

struct CycleOutput {
  GuardOutput output;     // what goes to the robot controller
  Correction correction;  // what the inverse said, before the guard
};

/// The whole state of the cycle in one object of known size.
///
/// One step: take the model, age the inputs, solve once, guard.
///   seed       commanded joints if they came, else the last solution, else the measured joints;
///              the last solution counts until a step is refused, so the arm is found again
///   direction  from the commanded joints if they came, else from the measured ones
///   stale      no sound target, or no sound joint state, for longer than its limit: the correction
///              ramps out on top of the last target, status kStale; back in when it arrives
///   a target that arrives and is no pose: the last output is held, and it does not count as fresh
///   a model of the slot that is new: taken at the beginning of the step, absorbed by the guard
///
/// Heap: none. Thread: one; the slot's loader may run beside it. Cost: fixed for a given model.
/// Errors: by status only; always returns, always finite, whatever the bits of the input are.
class Cycle {
 public:
  /// The slot must outlive the cycle.
  explicit Cycle(ModelSlot& slot, const CycleSettings& settings = {}) noexcept;

  CycleOutput step(const CycleInput& input) noexcept;

  /// From the next step on the correction ramps out to zero (kOff) or back in.
  void enable(Guard::Enable on) noexcept { guard_.enable(on); }

  /// Of the last step; the same thread.
  const GuardCounters& counters() const noexcept { return guard_.counters(); }
  const Context& context() const noexcept { return context_; }
  const LoadedModel& model() const noexcept { return *model_; }
  double target_age_s() const noexcept { return target_age_.value_s(); }
  double joints_age_s() const noexcept { return joints_age_.value_s(); }

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
  Transformd X_BD_;  // the last sound target
  Joints q_measured_ = Context::unknown();
  Joints q_commanded_ = Context::unknown();
  Joints q_solution_{};
  bool has_solution_ = false;
  SeedKind move_source_ = SeedKind::kMeasured;
};

static_assert(sizeof(Cycle) <= 2048);
static_assert(std::is_trivially_destructible_v<Cycle>);

}  // namespace plumb
