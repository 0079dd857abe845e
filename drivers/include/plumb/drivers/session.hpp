// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "plumb/drivers/bus_content.hpp"
#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/sensor_places.hpp"
#include "plumb/drivers/session_acknowledgement.hpp"
#include "plumb/drivers/session_arm.hpp"
#include "plumb/drivers/session_inbox.hpp"
#include "plumb/drivers/session_inputs.hpp"
#include "plumb/drivers/session_share.hpp"
#include "plumb/drivers/session_sync.hpp"
#include "plumb/drivers/session_target.hpp"
#include "plumb/drivers/session_transition.hpp"
#include "plumb/runtime/cycle.hpp"
#include "plumb/runtime/detail/kept_pose.hpp"

namespace plumb::drivers {

/// What the runs before leave for a session to begin with.
struct SessionStart {
  enum class Acknowledgement : std::uint8_t { kNotNeeded, kNeeded };

  FaultCause fault = FaultCause::kNone;  // of the last run, not acknowledged: begins in FAULT
  Acknowledgement acknowledgement = Acknowledgement::kNotNeeded;  // before the first correction
};

struct SessionSettings {
  CorrectionMode mode = CorrectionMode::kShadow;
  CorrectionForm form = CorrectionForm::kPose;
  std::uint32_t robot = 0;  // fingerprint of the model's serial number
  ShareSettings share = {};
  SyncSettings sync = {};
  TargetLimits target = {};
  ArmLimits arm = {};
  InputSettings inputs = {};
  double cycle_s = 0.004;
  double answer_s = 0.02;    // an older target is not answered
  double rearm_s = 0.5;      // how long the inputs must be good before a correction begins
  double foreign_s = 1.0;    // how long another sender of our identifiers counts as present
  double status_s = 0.02;    // period of the status
  double signature_s = 0.2;  // period of the signature
  CycleSettings cycle = {};
  SensorPlaces sensors = sensors_in_order();
  SessionStart start = {};
};

/// The inputs of a cycle besides its messages.
struct SessionTick {
  std::int64_t now_ns = 0;
  std::uint64_t foreign_senders = 0;                                // the port's counter of them
  enum class Run : std::uint8_t { kGoOn, kStop } run = Run::kGoOn;  // kStop: ramp out for good
  enum class Host : std::uint8_t {
    kAwake,
    kSlept,  // the machine was suspended since the last step, which now_ns does not show
  } host = Host::kAwake;
  enum class Peer : std::uint8_t {
    kSame,
    kRestarted,  // the port saw since the last step that the controller was restarted
  } peer = Peer::kSame;
  enum class Answers : std::uint8_t {
    kTaken,
    kRefused,  // the controller refuses what is written to it
  } answers = Answers::kTaken;
};

/// The messages to send, in this order.
struct SessionOutput {
  std::array<BusMessage, 3> messages;
  std::size_t size = 0;

  /// The messages in use. Deleted for temporary outputs, which a range-for would outlive.
  std::span<const BusMessage> sent() const& noexcept { return std::span(messages).first(size); }
  std::span<const BusMessage> sent() const&& = delete;
};

/// Counters of a session. They only grow.
struct SessionCounters {
  std::uint64_t cycles = 0;
  std::uint64_t targets = 0;   // targets accepted
  std::uint64_t answered = 0;  // targets answered with a corrected pose or an offset
  std::uint64_t repeated = 0;
  std::uint64_t out_of_order = 0;
  std::uint64_t no_pose = 0;
  std::uint64_t too_far = 0;
  std::uint64_t too_fast = 0;
  std::uint64_t too_old = 0;    // targets that had waited too long to be answered
  std::uint64_t no_joints = 0;  // joint states with a value that is no joint position
  std::uint64_t stalls = 0;     // times that cycles were missed for longer than an input's limit
  std::uint64_t holds = 0;      // transitions from ACTIVE to HOLD
  std::uint64_t faults = 0;
};

/// The state of a session for display. It refers to nothing, so it may be copied and kept.
struct SessionReport {
  SessionState state = SessionState::kInit;
  FaultCause cause = FaultCause::kNone;  // cause of the last FAULT
  CorrectionMode mode = CorrectionMode::kShadow;
  Status status = Status::kNoModel;
  Lost lost = {};  // what now prevents a correction
  bool has_output = false;
  double target_age_s = 0.0, joints_age_s = 0.0, controller_age_s = 0.0, robot_age_s = 0.0;
  double wanted_m = 0.0, wanted_rad = 0.0;    // size of the correction as the guard limits it
  double applied_m = 0.0, applied_rad = 0.0;  // size of the correction that is sent
  SyncCounters sync;
  SessionCounters counters;
  GuardCounters guard;
};

/// The logic of plumb-rt, from received messages to sent ones: the states of session_transition.hpp
/// around the cycle of the runtime. In every cycle call hear() for each message, then step() once.
///
///     messages --> order, limits --> Cycle: solve, guard --> share of the mode --> answer
///                  pose check, inputs --> state ------------^
///
/// In ACTIVE and HOLD, and in FAULT until one answer without a correction was sent, each new
/// accepted target (the newest, if several arrived in a cycle) is answered once with the corrected
/// pose or the offset, under the counter of the target. A target that is too old, is no pose, or
/// exceeds its limits is not answered, nor is any target before the guard has an output. Status and
/// signature are sent at their periods in every state; the counter of the status is plumb-rt's
/// heart-beat. It also says when an operator's acknowledgement is asked for.
///
/// A correction begins, changes and ends only by the guard's ramps and slew limits. Cycles missed
/// for longer than an input's limit are a lost input: the correction is then where the ramp would
/// have taken it meanwhile, ramps out and begins anew from zero.
///
/// No system call, no allocation. Thread: one; the loader of the slot may run at the same time.
/// Cost: fixed for a given model and number of messages. The same calls give the same output, to
/// the bit.
class Session {
 public:
  /// The slot must outlive the session.
  Session(ModelSlot& slot, const SessionSettings& settings) noexcept;

  void hear(const BusMessage& message) noexcept;
  SessionOutput step(const SessionTick& tick) noexcept;

  /// Changes the mode from the next step on; the correction does not jump.
  void set_mode(CorrectionMode mode) noexcept { settings_.mode = mode; }

  /// True if no correction is sent: it is zero, or targets are not answered.
  bool at_rest() const noexcept { return !answering() || at_zero(); }

  SessionState state() const noexcept { return state_; }

  /// The longest time that a correction of the running model takes to ramp out [s].
  double ramp_out_s() const noexcept;

  /// Number of the model that the last step used: the fingerprint of its file.
  std::uint32_t model() const noexcept { return cycle_.model().number(); }

  const SessionReport& report() const noexcept { return report_; }

  /// Goes on where another session was when its memory was copied (session_copy.hpp). `copy`: its
  /// bytes, made by a program in which sessions have the same layout; slot: begins with the model
  /// that it used. No effect if the size is another one.
  void resume(std::span<const std::byte> copy, ModelSlot& slot) noexcept;

 private:
  void hear_target(const BusMessage& message) noexcept;
  CycleInput cycle_input(std::int64_t now_ns) const noexcept;
  void take_target() noexcept;
  void hear_joints(const BusMessage& message) noexcept;
  void hear_actual(const BusMessage& message) noexcept;
  void note_stall(const SessionTick& tick, double dt_s) noexcept;
  void note_permission(const SessionTick& tick, double ageing_s) noexcept;
  Lost find_all_lost(const SessionTick& tick) const noexcept;
  void note_foreign(const SessionTick& tick, double ageing_s) noexcept;
  FaultCause fault() const noexcept;
  bool asks() const noexcept;
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
  ArmWatch arm_;
  AcknowledgeButton button_;
  CorrectionShare share_;
  CycleTime time_;
  SessionState state_ = SessionState::kInit;
  BusMessage target_;                   // the newest accepted target
  KeptPose X_BD_;                       // pose of the target
  KeptPose X_BC_;                       // corrected pose of the target
  bool target_came_ = false;            // a target arrived in this cycle and is not too old
  bool target_misbehaved_ = false;      // a target of this cycle exceeded its limits
  bool acknowledged_ = false;           // an operator acknowledged in this cycle
  bool needs_acknowledgement_ = false;  // before the first correction
  bool has_output_ = false;             // the guard has an output
  bool owes_zero_ = false;              // the last answer contained a correction
  bool stalled_ = false;                // the cycles before this one were missed for too long
  bool after_stall_ = false;            // true from a stall until the correction begins anew
  double overdue_s_ = 0.0;              // time in this cycle for which the inputs had been lost
  double permitted_s_ = 0.0;            // how long the inputs have been good
  double foreign_age_s_ = std::numeric_limits<double>::infinity();  // time since another sender
  std::uint64_t foreign_senders_ = 0;
  double status_due_s_ = 0.0;
  double signature_due_s_ = 0.0;
  std::uint16_t counter_ = 0;  // counter of the status
  std::uint16_t signature_counter_ = 0;
  Lost lost_ = {};
  SessionReport report_;
};

// A recorder copies its bytes, and a replay resumes from them.
static_assert(std::is_trivially_copyable_v<Session>);

}  // namespace plumb::drivers
