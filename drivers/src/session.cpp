// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/session.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "plumb/drivers/session_context.hpp"

namespace plumb::drivers {
namespace {

void count(TargetVerdict verdict, SessionCounters& counters) noexcept {
  switch (verdict) {
    case TargetVerdict::kAccepted:
      ++counters.targets;
      return;
    case TargetVerdict::kRepeated:
      ++counters.repeated;
      return;
    case TargetVerdict::kOutOfOrder:
      ++counters.out_of_order;
      return;
    case TargetVerdict::kNoPose:
      ++counters.no_pose;
      return;
    case TargetVerdict::kTooFar:
      ++counters.too_far;
      return;
    case TargetVerdict::kTooFast:
      ++counters.too_fast;
      return;
  }
}

constexpr double kSleep_s = 3600.0;  // counts for a suspension of the machine, however long it was

bool is_finite(const BusMessage& message) noexcept {
  for (std::size_t i = 0; i < message.size; ++i)
    if (!std::isfinite(message.values[i])) return false;
  return true;
}

/// Counts `due_s` down. Returns true when it has run out, and then restarts it with the period.
bool is_due(double& due_s, double ageing_s, double period_s) noexcept {
  due_s -= ageing_s;
  if (due_s > 0.0) return false;
  due_s = std::max(due_s + period_s, 0.5 * period_s);
  return true;
}

}  // namespace

Session::Session(ModelSlot& slot, const SessionSettings& settings) noexcept
    : settings_(settings),
      cycle_(slot, settings.cycle),
      sync_(settings.sync),
      gate_(settings.target),
      arm_(settings.arm),
      share_(settings.share) {
  using Acknowledgement = SessionStart::Acknowledgement;
  needs_acknowledgement_ = settings.start.acknowledgement == Acknowledgement::kNeeded;
  report_.mode = settings.mode;
  report_.cause = settings.start.fault;
  if (settings.start.fault != FaultCause::kNone) state_ = SessionState::kFault;
}

void Session::resume(std::span<const std::byte> copy, ModelSlot& slot) noexcept {
  if (copy.size() != sizeof(Session)) return;
  std::memcpy(this, copy.data(), sizeof(Session));
  cycle_.rebind(slot);  // all that it holds besides are numbers
}

void Session::hear(const BusMessage& message) noexcept {
  switch (message.kind) {
    case MessageKind::kTarget:
      return hear_target(message);
    case MessageKind::kJoints:
      return hear_joints(message);
    case MessageKind::kActual:
      return hear_actual(message);
    case MessageKind::kController:
      if (button_.hear(message, asks())) acknowledged_ = true;
      break;
    case MessageKind::kRobot:
      if (!std::isfinite(message.values[0])) return;
      break;
    default:
      break;
  }
  inbox_.hear(message);
}

/// Joints that are no numbers are not heard, so they are lost after a while.
void Session::hear_joints(const BusMessage& message) noexcept {
  const Chain& nominal = cycle_.model().corrector().nominal();
  const auto n = static_cast<std::size_t>(nominal.joints());
  const std::span q = std::span(message.values).first(n);
  if (message.size < n || !is_joint_state(q)) {
    ++report_.counters.no_joints;
    return;
  }
  arm_.show_joints(q);
  BusMessage angles = message;
  cycle_.model().coupling().to_angles(angles.values);
  sync_.hear(angles, nominal);
  inbox_.hear(message);
}

void Session::hear_actual(const BusMessage& message) noexcept {
  const auto X_BA = pose_in(message);
  if (!X_BA) return;
  arm_.show(*X_BA);
  sync_.hear(message, cycle_.model().corrector().nominal());
  inbox_.hear(message);
}

void Session::hear_target(const BusMessage& message) noexcept {
  Transformd X_BD;
  const TargetVerdict verdict = gate_.judge(message, X_BD);
  count(verdict, report_.counters);
  if (verdict == TargetVerdict::kTooFar || verdict == TargetVerdict::kTooFast) {
    target_misbehaved_ = true;
    arm_.jump();
  }
  if (verdict != TargetVerdict::kAccepted) return;
  target_ = message;
  arm_.aim(X_BD);
  inbox_.hear(message);
}

/// Takes the target of this cycle. A target that is too old is ignored and counted.
void Session::take_target() noexcept {
  target_came_ = inbox_.came(MessageKind::kTarget);
  if (target_came_ && !inbox_.within(MessageKind::kTarget, settings_.answer_s)) {
    ++report_.counters.too_old;
    target_came_ = false;
  }
  if (target_misbehaved_) target_came_ = false;
  if (!target_came_) return;
  if (const auto X_BD = pose_in(target_)) X_BD_ = *X_BD;
}

CycleInput Session::cycle_input(std::int64_t now_ns) const noexcept {
  CycleInput out{.now_ns = now_ns};
  if (target_came_) {
    out.target = Arrival::kArrived;
    out.X_BD = X_BD_;
  }
  const auto take = [this](MessageKind kind, auto& q) {
    const auto& values = inbox_.last(kind).values;
    std::copy_n(values.begin(), std::min(q.size(), values.size()), q.begin());
  };
  const bool measured = inbox_.came(MessageKind::kJoints) &&
                        inbox_.within(MessageKind::kJoints,
                                      longest_silence_s(MessageKind::kJoints, settings_.inputs));
  const bool commanded = target_came_ && inbox_.came(MessageKind::kCommanded) &&
                         inbox_.last(MessageKind::kCommanded).counter == target_.counter;
  if (measured || commanded) out.joints = Arrival::kArrived;
  if (measured) take(MessageKind::kJoints, out.q_measured);
  if (commanded) take(MessageKind::kCommanded, out.q_commanded);
  out.context = context_in(inbox_, settings_.sensors);
  return out;
}

/// Cycles missed for longer than an input's limit: during them every input was lost.
void Session::note_stall(const SessionTick& tick, double dt_s) noexcept {
  const bool slept = tick.host == SessionTick::Host::kSlept;
  const double limit_s = std::max(settings_.inputs.limit_s, 3.0 * settings_.cycle_s);
  stalled_ = slept || dt_s > limit_s;
  overdue_s_ = slept ? kSleep_s : stalled_ ? dt_s - limit_s : 0.0;
  if (!stalled_) return;
  ++report_.counters.stalls;
  after_stall_ = answering();
}

Lost Session::find_all_lost(const SessionTick& tick) const noexcept {
  const auto when = [](bool lost, Lost one) { return lost ? one : Lost::kNothing; };
  return find_lost(inbox_, settings_.inputs) | when(target_misbehaved_, Lost::kMotion) |
         when(sync_.silent(), Lost::kComparison) | when(arm_.away(), Lost::kArmAway) |
         when(arm_.still(), Lost::kArmStill) | when(stalled_, Lost::kStall) |
         when(needs_acknowledgement_, Lost::kAcknowledge) |
         when(tick.peer == SessionTick::Peer::kRestarted, Lost::kRestart) |
         when(tick.answers == SessionTick::Answers::kRefused, Lost::kAnswers);
}

/// Before the first correction an acknowledgement counts once the poses were compared, so that it
/// is given to what plumb-rt then shows.
void Session::note_permission(const SessionTick& tick, double ageing_s) noexcept {
  if (acknowledged_ && state_ == SessionState::kShadow) needs_acknowledgement_ = false;
  lost_ = find_all_lost(tick);
  permitted_s_ = lost_ == Lost::kNothing ? permitted_s_ + ageing_s : 0.0;
  if (has(lost_, Lost::kRestart)) button_.forget();
}

void Session::note_foreign(const SessionTick& tick, double ageing_s) noexcept {
  foreign_age_s_ = tick.foreign_senders == foreign_senders_ ? foreign_age_s_ + ageing_s : 0.0;
  foreign_senders_ = tick.foreign_senders;
}

FaultCause Session::fault() const noexcept {
  if (foreign_age_s_ < settings_.foreign_s) return FaultCause::kForeignSender;
  const BusMessage& robot = inbox_.last(MessageKind::kRobot);
  if (robot.size > 0 && robot.values[0] != static_cast<double>(settings_.robot))
    return FaultCause::kOtherRobot;
  return sync_.mismatched() ? FaultCause::kPoseMismatch : FaultCause::kNone;
}

/// True while an acknowledgement would have an effect: in FAULT when the cause is gone and the
/// correction is out, and in SHADOW before the first correction.
bool Session::asks() const noexcept {
  if (state_ == SessionState::kFault) return fault() == FaultCause::kNone && at_zero();
  return state_ == SessionState::kShadow && needs_acknowledgement_;
}

SessionFacts Session::facts(const SessionTick& tick) const noexcept {
  return {.fault = fault(),
          .heard = is_heard(inbox_, settings_.inputs),
          .synced = sync_.agreed(),
          .permitted = permitted_s_ >= settings_.rearm_s,
          .lost = lost_ != Lost::kNothing,
          .at_zero = at_zero(),
          .acknowledged = acknowledged_,
          .stopping = tick.run == SessionTick::Run::kStop,
          .mode = settings_.mode};
}

void Session::change_state(const SessionTick& tick) noexcept {
  const SessionFacts now = facts(tick);
  const SessionState next = next_state(state_, now);
  if (next == state_) return;
  if (next == SessionState::kFault) {
    report_.cause = now.fault;
    ++report_.counters.faults;
  }
  enter(next);
}

void Session::enter(SessionState state) noexcept {
  if (state == SessionState::kHold) ++report_.counters.holds;
  if (state == SessionState::kActive) after_stall_ = false;
  if (state_ == SessionState::kFault) needs_acknowledgement_ = false;
  if (state == SessionState::kInit) {
    sync_.restart();
    report_.cause = FaultCause::kNone;
  }
  state_ = state;
}

bool Session::at_zero() const noexcept {
  const bool asked = inbox_.within(MessageKind::kTarget, settings_.cycle.target_limit_s);
  return share_.at_zero() && !(asked && owes_zero_);
}

bool Session::answering() const noexcept {
  if (state_ == SessionState::kFault) return !at_zero();
  return state_ == SessionState::kActive || state_ == SessionState::kHold;
}

double Session::ramp_out_s() const noexcept {
  const format::GuardLimits& limits = cycle_.model().limits();
  const auto s = [](double way, double slew) { return slew > 0.0 ? way / slew : 0.0; };
  return limits.ramp_s + std::max(s(limits.max_correction_m, limits.slew_m_per_s),
                                  s(limits.max_rotation_rad, limits.slew_rad_per_s));
}

GuardOutput Session::correct(std::int64_t now_ns, double dt_s) noexcept {
  cycle_.enable(computes(state_) ? Guard::Enable::kOn : Guard::Enable::kOff);
  GuardOutput guarded = cycle_.step(cycle_input(now_ns)).output;
  const format::GuardLimits& limits = cycle_.model().limits();
  if (answering()) {
    const double most_s = 2.0 * limits.cycle_s;
    const CorrectionMode mode = after_stall_ ? CorrectionMode::kShadow : settings_.mode;
    X_BC_ = share_.step(X_BD_, guarded.X_BC, mode, limits, std::min(dt_s, most_s) + overdue_s_);
  } else {
    share_.reset();
    after_stall_ = false;
    owes_zero_ = false;
  }
  has_output_ = guarded.has_output;
  return guarded;
}

void Session::answer(SessionOutput& out) noexcept {
  if (!answering() || !target_came_ || !has_output_) return;
  const BusMessage said = settings_.form == CorrectionForm::kOffset
                              ? offset_message(X_BD_, X_BC_, target_.counter)
                              : pose_message(MessageKind::kCorrected, X_BC_, target_.counter);
  if (!is_finite(said)) return;
  ++report_.counters.answered;
  owes_zero_ = !share_.at_zero();
  out.messages[out.size++] = said;
}

void Session::tell(double ageing_s, SessionOutput& out) noexcept {
  if (is_due(status_due_s_, ageing_s, settings_.status_s))
    out.messages[out.size++] =
        status_message({.state = state_,
                        .mode = settings_.mode,
                        .status = report_.status,
                        .asks = asks(),
                        .has_output = report_.has_output,
                        .refused = static_cast<std::uint16_t>(report_.guard.refused),
                        .limited = static_cast<std::uint16_t>(report_.guard.limited),
                        .stale = static_cast<std::uint16_t>(report_.guard.stale)},
                       ++counter_);
  if (is_due(signature_due_s_, ageing_s, settings_.signature_s))
    out.messages[out.size++] = signature_message(model(), settings_.robot, ++signature_counter_);
}

void Session::fill_report(const GuardOutput& guarded) noexcept {
  report_.state = state_;
  report_.mode = settings_.mode;
  report_.status = guarded.status;
  report_.lost = lost_ | (after_stall_ ? Lost::kStall : Lost::kNothing);
  report_.has_output = answering() && guarded.has_output;
  report_.target_age_s = inbox_.age_s(MessageKind::kTarget);
  report_.joints_age_s = inbox_.age_s(MessageKind::kJoints);
  report_.controller_age_s = inbox_.age_s(MessageKind::kController);
  report_.robot_age_s = inbox_.age_s(MessageKind::kRobot);
  const Transformd X_BD = X_BD_;
  report_.wanted_m = (guarded.X_BC.p - X_BD.p).norm();
  report_.wanted_rad = rotation_vector(times_transposed<double>(guarded.X_BC.R, X_BD.R)).norm();
  report_.applied_m = share_.translation_m();
  report_.applied_rad = share_.rotation_rad();
  report_.sync = sync_.counters();
  report_.guard = cycle_.counters();
  ++report_.counters.cycles;
}

SessionOutput Session::step(const SessionTick& tick) noexcept {
  const CycleTime::Tick time = time_.tick(tick.now_ns, settings_.cycle_s);
  inbox_.step(tick.now_ns, time.ageing_s);
  sync_.step(time.ageing_s);
  arm_.step(time.ageing_s);
  note_stall(tick, time.dt_s);
  take_target();
  note_permission(tick, time.ageing_s);
  note_foreign(tick, time.ageing_s);
  change_state(tick);
  fill_report(correct(tick.now_ns, time.dt_s));
  SessionOutput out;
  answer(out);
  tell(time.ageing_s, out);
  inbox_.close();
  target_came_ = target_misbehaved_ = acknowledged_ = false;
  return out;
}

}  // namespace plumb::drivers
