// SPDX-License-Identifier: Apache-2.0
#include "twin/controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cell/joint_columns.hpp"
#include "twin/transforms.hpp"

namespace plumb::offline::twin {
namespace {

using drivers::BusMessage;
using drivers::MessageKind;

constexpr double kRest_s = 0.06;       // time without motion until the arm counts as at rest
constexpr double kStill_m = 1.5e-6;    // the bus counts in micrometres
constexpr double kServoStill = 2e-7;   // [rad] or [m] from the goal
constexpr double kOtherTool_m = 0.02;  // length by which a wrong tool differs
constexpr double kForeign_m = 0.001;   // what a second sender adds to the target

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

VectorXd row(const Path& path, int station) {
  return path.q.row(std::min(station, path.stations() - 1)).transpose();
}

}  // namespace

Controller::Controller(const Cell& cell, const Path& path, const ControllerSettings& settings,
                       Corrections corrections, const drivers::BusLayout& layout,
                       const FaultPlan& faults, TwinTime& time)
    : path_(path),
      settings_(settings),
      corrections_(corrections),
      faults_(faults),
      time_(time),
      arm_(cell.nominal),
      serial_(drivers::fingerprint(cell.serial)),
      move_(arm_, row(path, 0), row(path, 0), settings.fastest),
      q_path_(row(path, 0)),
      q_commanded_(q_path_),
      q_measured_(q_path_),
      q_frozen_(q_path_),
      X_BD_(arm_.forward(q_path_)),
      receiver_(settings.receiver) {
  for (const auto& message : layout.messages)
    every_.emplace_back(message.kind, static_cast<std::uint64_t>(std::max(
                                          1.0, std::round(message.period_s / settings.cycle_s))));
  if (const auto* context = layout.find(MessageKind::kContext)) context_ = *context;
  if (corrections_ == Corrections::kIgnore || settings.wait_s == 0.0) phase_ = Phase::kPath;
}

double Controller::session_age_s() const {
  return has_status_ ? seconds(time_.now_ns - status_ns_) : std::numeric_limits<double>::infinity();
}

void Controller::cycle(std::int64_t now_ns, drivers::BusPort* port) {
  if (counters_.cycles++ == 0) start_ns_ = now_ns;
  time_.now_ns = now_ns;
  if (phase_ == Phase::kPath && path_ns_ == 0) path_ns_ = now_ns;
  time_.path_s = phase_ == Phase::kPath ? seconds(now_ns - path_ns_) : -1.0;
  if (fault(FaultKind::kReboot)) return reboot();
  was_down_ = false;
  if (port != nullptr) hear(*port);
  if (fault(FaultKind::kDrivesOff) || fault(FaultKind::kStop)) {
    stand();
  } else {
    set_out_again();
    advance();
    drive();
  }
  if (port != nullptr) say(*port);
  ++counter_;
}

void Controller::reboot() {
  if (was_down_) return;
  was_down_ = true;
  receiver_.restart();
  counter_ = 0;
  has_status_ = false;
}

void Controller::hear(drivers::BusPort& port) {
  BusMessage message;
  while (port.receive(message)) {
    receiver_.hear(message, time_.now_ns);
    if (message.kind == MessageKind::kStatus) hear_status(message);
  }
}

void Controller::hear_status(const BusMessage& message) {
  session_ = drivers::status_in(message);
  status_ns_ = time_.now_ns;
  has_status_ = true;
  const bool shadow = session_.state == drivers::SessionState::kShadow;
  shadow_ns_ = !shadow ? 0 : shadow_ns_ == 0 ? time_.now_ns : shadow_ns_;
  if (states_.empty() || states_.back().state != session_.state)
    states_.push_back({session_.state, time_.path_s});
  if (session_.state == drivers::SessionState::kActive && counters_.first_active_s < 0.0)
    counters_.first_active_s = seconds(time_.now_ns - start_ns_);
}

bool Controller::corrections_are_there() const {
  return has_status_ && session_.state == drivers::SessionState::kActive &&
         session_.status != Status::kRamping && !refused(session_.status) &&
         receiver_.fresh(time_.now_ns);
}

bool Controller::at_rest() const {
  if ((q_commanded_ - q_measured_).cwiseAbs().maxCoeff() > kServoStill) return false;
  const auto now = receiver_.present().translation;
  return std::all_of(recent_.begin(), recent_.end(), [&](const Offset& before) {
    return (before.translation - now).norm() < kStill_m;
  });
}

void Controller::set_out(const VectorXd& to) {
  move_ = Move(arm_, q_path_, to, settings_.fastest);
  move_s_ = rest_s_ = 0.0;
}

void Controller::arrive() {
  const bool waited = rest_s_ >= settings_.longest_dwell_s;
  if (rest_s_ < settings_.dwell_s || (!waited && !at_rest())) return;
  if (phase_ == Phase::kApproach) {
    if (corrections_are_there() && walk_ <= 1) {
      phase_ = Phase::kPath;
      return set_out(row(path_, 0));
    }
    gave_up_ = seconds(time_.now_ns - start_ns_) >= settings_.wait_s;
    walk_on();
    return set_out(row(path_, walk_));
  }
  stops_.push_back({station_, q_measured_, X_BD_, receiver_.present(), !waited, time_.path_s});
  if (++station_ < path_.stations()) set_out(row(path_, station_));
}

/// To the first stations and back, each time one farther: plumb-rt wants to compare distinct poses.
/// Only the ways between neighbours are known to be away from singular poses.
void Controller::walk_on() {
  if (walk_ == 0) back_ = false;
  if (walk_ >= farthest_) back_ = true;
  walk_ += back_ ? -1 : 1;
  if (walk_ == 0) farthest_ = std::min(farthest_ + 1, std::max(1, path_.stations() - 1));
}

Receiver::Own Controller::own_state() const {
  return {.drives_on = !fault(FaultKind::kDrivesOff),
          .automatic = !fault(FaultKind::kManual),
          .acknowledge = state().acknowledge};
}

/// The cycle of an arm whose drives are off or that is at a protective stop: it stays where it is,
/// whatever the correction.
void Controller::stand() {
  stood_ = true;
  receiver_.step(time_.now_ns, settings_.cycle_s, own_state());
  recent_.clear();
}

/// When the arm moves again, the path begins where it stands, so that the command does not jump by
/// the correction that was taken away meanwhile.
void Controller::set_out_again() {
  if (!stood_) return;
  stood_ = false;
  q_path_ = q_commanded_ = q_measured_;
  if (!done()) set_out(row(path_, phase_ == Phase::kPath ? station_ : walk_));
}

void Controller::advance() {
  if (done()) return;
  if (move_s_ < move_.duration_s()) {
    move_s_ += settings_.cycle_s;
  } else {
    rest_s_ += settings_.cycle_s;
    arrive();
  }
  q_path_ = move_.at(move_s_);
}

void Controller::drive() {
  X_BD_ = arm_.forward(q_path_);
  const Vector3d before = receiver_.present().translation;
  if (corrections_ == Corrections::kUse) {
    receiver_.step(time_.now_ns, settings_.cycle_s, own_state());
    recent_.push_back(receiver_.present());
    if (static_cast<double>(recent_.size()) * settings_.cycle_s > kRest_s)
      recent_.erase(recent_.begin());
  }
  const Vector3d now = receiver_.present().translation;
  counters_.largest_step_m = std::max(counters_.largest_step_m, (now - before).norm());
  counters_.largest_offset_m = std::max(counters_.largest_offset_m, now.norm());
  VectorXd q = q_commanded_;
  if (!arm_.inverse(applied(receiver_.present(), X_BD_), q))
    ++counters_.no_inverse;
  else
    q_commanded_ = q;
  const double share = 1.0 - std::exp(-settings_.cycle_s / settings_.servo_s);
  q_measured_ += share * (q_commanded_ - q_measured_);
  if (!fault(FaultKind::kFreeze)) q_frozen_ = q_measured_;
}

Isometry3d Controller::shown_pose() const {
  const bool corrects = fault(FaultKind::kAbsolute) && own_;
  Isometry3d out = corrects ? own_->forward(q_measured_) : arm_.forward(q_measured_);
  if (fault(FaultKind::kTool)) out.translate(Vector3d(0.0, 0.0, kOtherTool_m));
  return out;
}

/// Pressed for 0.3 s in every second, the first time after half of it.
bool Controller::operator_acknowledges() const {
  if (shadow_ns_ == 0) return false;
  const double second = std::fmod(seconds(time_.now_ns - shadow_ns_), 1.0);
  return second >= 0.5 && second < 0.8;
}

drivers::ControllerState Controller::state() const {
  return {.drives_on = !fault(FaultKind::kDrivesOff),
          .automatic = !fault(FaultKind::kManual),
          .protective_stop = fault(FaultKind::kStop),
          .correction_enabled = !fault(FaultKind::kDisable),
          .acknowledge = fault(FaultKind::kAcknowledge) || operator_acknowledges(),
          .tool = static_cast<std::uint8_t>(settings_.tool + (fault(FaultKind::kTool) ? 1 : 0)),
          .frame = settings_.frame,
          .payload = settings_.payload};
}

void Controller::say(drivers::BusPort& port, const BusMessage& message) {
  for (const auto& [kind, cycles] : every_)
    if (kind == message.kind && counter_ % cycles == 0) (void)port.send(message);
}

void Controller::say_context(drivers::BusPort& port) {
  if (!context_ || along_.empty() || fault(FaultKind::kNoContext)) return;
  const auto at = std::min(static_cast<std::size_t>(station_), along_.size() - 1);
  say(port, context_message(*context_, along_[at], counter_));
}

void Controller::say(drivers::BusPort& port) {
  receiver_.sent(counter_, X_BD_, time_.now_ns);
  const auto joints = [this](MessageKind kind, const VectorXd& q) {
    const auto values = values_at({q.data(), static_cast<std::size_t>(q.size())}, arm_.chain());
    return drivers::joints_message(kind, values, counter_);
  };
  say(port, drivers::controller_message(state(), counter_));
  say(port, joints(MessageKind::kJoints, q_frozen_));
  say(port, joints(MessageKind::kCommanded, q_path_));
  say(port, drivers::pose_message(MessageKind::kTarget, to_transform(X_BD_), counter_));
  say(port, drivers::pose_message(MessageKind::kActual, to_transform(shown_pose()), counter_));
  say(port, drivers::robot_message(serial_, counter_));
  say_context(port);
  if (!fault(FaultKind::kSecondSender)) return;
  Isometry3d foreign = X_BD_;
  foreign.translation().x() += kForeign_m;
  (void)port.send(drivers::pose_message(MessageKind::kCorrected, to_transform(foreign), counter_));
  (void)port.send(drivers::offset_message(to_transform(X_BD_), to_transform(foreign), counter_));
}

}  // namespace plumb::offline::twin
