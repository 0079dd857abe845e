// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "plumb/drivers/bus_content.hpp"
#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/sensor_places.hpp"
#include "plumb/drivers/session_inbox.hpp"
#include "plumb/drivers/session_inputs.hpp"
#include "plumb/drivers/session_share.hpp"
#include "plumb/drivers/session_sync.hpp"
#include "plumb/drivers/session_target.hpp"
#include "plumb/drivers/session_transition.hpp"
#include "plumb/runtime/cycle.hpp"

namespace plumb::drivers {

struct SessionSettings {
  CorrectionMode mode = CorrectionMode::kShadow;
  CorrectionForm form = CorrectionForm::kPose;
  std::uint32_t robot = 0;  // fingerprint of the model's serial number
  ShareSettings share = {};
  SyncSettings sync = {};
  TargetLimits target = {};
  InputSettings inputs = {};
  double cycle_s = 0.004;
  double answer_s = 0.02;    // the oldest target that is answered
  double rearm_s = 0.5;      // for which the inputs must have been good before a correction begins
  double foreign_s = 1.0;    // for which another sender of our identifiers counts
  double status_s = 0.02;    // from one status to the next
  double signature_s = 0.2;  // from one signature to the next
  CycleSettings cycle = {};
  SensorPlaces sensors = sensors_in_order();
};

/// What a cycle is told besides its messages.
struct SessionTick {
  std::int64_t now_ns = 0;
  std::uint64_t foreign_senders = 0;                                // of the port's counters
  enum class Run : std::uint8_t { kGoOn, kStop } run = Run::kGoOn;  // kStop: ramp out and stay so
};

/// What is to be sent, in this order.
struct SessionOutput {
  std::array<BusMessage, 3> messages;
  std::size_t size = 0;

  /// Of an output that stays: a range-for over a temporary one would outlive it.
  std::span<const BusMessage> sent() const& noexcept { return std::span(messages).first(size); }
  std::span<const BusMessage> sent() const&& = delete;
};

/// Monotone.
struct SessionCounters {
  std::uint64_t cycles = 0;
  std::uint64_t targets = 0;   // accepted
  std::uint64_t answered = 0;  // with a corrected target or an offset
  std::uint64_t repeated = 0;
  std::uint64_t out_of_order = 0;
  std::uint64_t no_pose = 0;
  std::uint64_t too_far = 0;
  std::uint64_t too_fast = 0;
  std::uint64_t too_old = 0;  // waited too long to be answered
  std::uint64_t holds = 0;    // times ACTIVE was left for HOLD
  std::uint64_t faults = 0;
};

/// What there is to know of a session; a copy is all of it.
struct SessionReport {
  SessionState state = SessionState::kInit;
  FaultCause cause = FaultCause::kNone;  // of the last FAULT
  CorrectionMode mode = CorrectionMode::kShadow;
  Status status = Status::kNoModel;
  Lost lost = {};  // what stands against a correction now
  bool has_output = false;
  double target_age_s = 0.0, joints_age_s = 0.0, controller_age_s = 0.0, robot_age_s = 0.0;
  double wanted_m = 0.0, wanted_rad = 0.0;    // the correction of the model, by the guard
  double applied_m = 0.0, applied_rad = 0.0;  // what is on the target
  SyncCounters sync;
  SessionCounters counters;
  GuardCounters guard;
};

/// What plumb-rt does, from message to message: the states of session_transition.hpp around the
/// cycle of the runtime. hear() every message of a cycle, then step() once.
///
///     messages --> order, limits --> Cycle: solve, guard --> share of the mode --> answer
///                  pose check, inputs --> state ------------^
///
/// Answers: in ACTIVE and HOLD, and in FAULT until one went out without a correction, each accepted
/// target that is new in the cycle (the newest, if several came) is answered once, under its
/// counter: with the corrected pose or the offset. A target that is too old, no pose, or beyond its
/// limits is not answered; neither is anything before the guard has an output. Status and signature
/// go out at their periods in every state; the counter of the status is plumb-rt's heart-beat.
///
/// Corrections only begin, end and change by the guard's ramps and slew limits.
///
/// No system call, no allocation. Thread: one; the slot's loader may run beside it. Cost: fixed for
/// given model and number of messages. The same calls give the same output, to the bit.
class Session {
 public:
  /// The slot must outlive the session.
  Session(ModelSlot& slot, const SessionSettings& settings) noexcept;

  void hear(const BusMessage& message) noexcept;
  SessionOutput step(const SessionTick& tick) noexcept;

  /// From the next step on; no step in the correction.
  void set_mode(CorrectionMode mode) noexcept { settings_.mode = mode; }

  /// Nothing of a correction is on the target, or nobody is told of any.
  bool at_rest() const noexcept { return !answering() || at_zero(); }

  SessionState state() const noexcept { return state_; }

  /// Number of the model that the last step went by: the fingerprint of its file.
  std::uint32_t model() const noexcept { return cycle_.model().number(); }

  const SessionReport& report() const noexcept { return report_; }

 private:
  void hear_target(const BusMessage& message) noexcept;
  void hear_controller(const BusMessage& message) noexcept;
  CycleInput cycle_input(std::int64_t now_ns) const noexcept;
  void take_target() noexcept;
  void note_permission(double ageing_s) noexcept;
  void note_foreign(const SessionTick& tick, double ageing_s) noexcept;
  FaultCause fault() const noexcept;
  SessionFacts facts(const SessionTick& tick) const noexcept;
  void change_state(const SessionTick& tick) noexcept;
  GuardOutput correct(std::int64_t now_ns, double dt_s) noexcept;
  void enter(SessionState state) noexcept;
  bool at_zero() const noexcept;
  bool answering() const noexcept;
  void answer(SessionOutput& out) noexcept;
  void tell(double ageing_s, SessionOutput& out) noexcept;
  void fill_report(const GuardOutput& guarded) noexcept;

  SessionSettings settings_;
  Cycle cycle_;
  SessionInbox inbox_;
  SyncCheck sync_;
  TargetGate gate_;
  CorrectionShare share_;
  CycleTime time_;
  SessionState state_ = SessionState::kInit;
  BusMessage target_;               // the newest accepted one
  Transformd X_BD_;                 // its pose
  Transformd X_BC_;                 // what it is corrected to
  bool target_came_ = false;        // in this cycle, and not too old
  bool target_misbehaved_ = false;  // in this cycle
  bool acknowledged_ = false;       // in this cycle
  bool acknowledge_was_on_ = true;  // until seen off
  bool has_output_ = false;         // of the guard
  bool owes_zero_ = false;          // the last answer had a correction in it
  double permitted_s_ = 0.0;        // for how long the inputs have been good
  double foreign_age_s_ = std::numeric_limits<double>::infinity();  // since another sender was seen
  std::uint64_t foreign_senders_ = 0;
  double status_due_s_ = 0.0;
  double signature_due_s_ = 0.0;
  std::uint16_t counter_ = 0;  // of the status
  std::uint16_t signature_counter_ = 0;
  Lost lost_ = {};
  SessionReport report_;
};

static_assert(std::is_trivially_destructible_v<Session>);

}  // namespace plumb::drivers
