// SPDX-License-Identifier: Apache-2.0
#include "twin/receiver.hpp"

#include <algorithm>

#include "twin/transforms.hpp"

namespace plumb::offline::twin {
namespace {

using drivers::MessageKind;

/// `value` moved towards `goal` by at most `most`.
Vector3d towards(const Vector3d& value, const Vector3d& goal, double most) {
  const Vector3d way = goal - value;
  const double length = way.norm();
  return length <= most ? goal : Vector3d(value + way * (most / length));
}

}  // namespace

Offset offset_between(const Isometry3d& X_BD, const Isometry3d& X_BC) {
  const Eigen::AngleAxisd turn(X_BC.linear() * X_BD.linear().transpose());
  return {X_BC.translation() - X_BD.translation(), turn.angle() * turn.axis()};
}

Isometry3d applied(const Offset& offset, const Isometry3d& X_BD) {
  Isometry3d out = X_BD;
  out.translation() += offset.translation;
  const double angle = offset.rotation.norm();
  if (angle > 0.0) out.linear() = Eigen::AngleAxisd(angle, offset.rotation / angle) * X_BD.linear();
  return out;
}

void Receiver::sent(std::uint16_t counter, const Isometry3d& X_BD, std::int64_t now_ns) {
  sent_[counter & 0xFFU] = {true, now_ns, X_BD};
  last_sent_ = counter;
}

/// The target of this counter, if it is one of those that are remembered.
const Receiver::Sent* Receiver::remembered(std::uint16_t counter) const {
  const unsigned before = static_cast<unsigned>(last_sent_ - counter) & 0xFFU;
  const Sent& target = sent_[counter & 0xFFU];
  return before < kRemembered && target.known ? &target : nullptr;
}

std::optional<Offset> Receiver::offset_in(const drivers::BusMessage& message,
                                          const Sent& target) const {
  if (message.kind == MessageKind::kOffset) {
    const Transformd X_BD = to_transform(target.X_BD);
    const Isometry3d X_BC = to_isometry(drivers::add_offset(X_BD, message));
    return offset_between(target.X_BD, X_BC);
  }
  const auto pose = drivers::pose_in(message);
  if (!pose) return std::nullopt;
  return offset_between(target.X_BD, to_isometry(*pose));
}

void Receiver::hear(const drivers::BusMessage& message, std::int64_t now_ns) {
  if (message.kind == MessageKind::kStatus) hear_status(message, now_ns);
  if (message.kind == MessageKind::kCorrected || message.kind == MessageKind::kOffset)
    hear_answer(message, now_ns);
}

void Receiver::hear_status(const drivers::BusMessage& message, std::int64_t now_ns) {
  if (has_status_ && message.counter == status_counter_) return;
  status_ = drivers::status_in(message);
  has_beat_ = has_status_;  // one status alone is no heart-beat: it may be an old one
  has_status_ = true;
  status_counter_ = message.counter;
  beat_ns_ = now_ns;
  const bool in_fault = status_.state == drivers::SessionState::kFault;
  faulted_ = in_fault || (faulted_ && !acknowledged_);
  acknowledged_ = acknowledged_ && faulted_;
}

/// Only pressing it after the fault acknowledges the fault.
void Receiver::see_button(bool pressed) {
  acknowledged_ = faulted_ && (acknowledged_ || (pressed && !pressed_));
  pressed_ = pressed;
}

void Receiver::hear_answer(const drivers::BusMessage& message, std::int64_t now_ns) {
  const Sent* const target = remembered(message.counter);
  if (target == nullptr) return void(++counters_.stale);
  const double age_s = 1e-9 * static_cast<double>(now_ns - target->time_ns);
  if (age_s > settings_.fresh_s) return void(++counters_.stale);
  if (has_wanted_ && target->time_ns < wanted_ns_) return void(++counters_.overtaken);
  const auto offset = offset_in(message, *target);
  const bool small = offset && offset->translation.norm() <= settings_.most_m &&
                     offset->rotation.norm() <= settings_.most_rad;
  if (!small) return void(++counters_.too_large);
  wanted_ = *offset;
  wanted_ns_ = target->time_ns;
  has_wanted_ = true;
  ++counters_.used;
  counters_.oldest_s = std::max(counters_.oldest_s, age_s);
}

bool Receiver::fresh(std::int64_t now_ns) const {
  return has_wanted_ && 1e-9 * static_cast<double>(now_ns - wanted_ns_) <= settings_.fresh_s;
}

bool Receiver::alive(std::int64_t now_ns) const {
  return has_beat_ && 1e-9 * static_cast<double>(now_ns - beat_ns_) <= settings_.fresh_s;
}

/// True if what is wanted may be the goal.
bool Receiver::applies(std::int64_t now_ns) const {
  using drivers::SessionState;
  const bool answers =
      status_.state == SessionState::kActive || status_.state == SessionState::kHold;
  return fresh(now_ns) && alive(now_ns) && answers && !faulted_ && status_.has_output;
}

const Offset& Receiver::step(std::int64_t now_ns, double dt_s, const Own& own) {
  see_button(own.acknowledge);
  if (!own.drives_on) return present_ = Offset{};
  const Offset goal = own.automatic && applies(now_ns) ? wanted_ : Offset{};
  present_.translation =
      towards(present_.translation, goal.translation, settings_.slew_m_per_s * dt_s);
  present_.rotation = towards(present_.rotation, goal.rotation, settings_.slew_rad_per_s * dt_s);
  return present_;
}

void Receiver::restart() {
  const Counters kept = counters_;
  *this = Receiver(settings_);
  counters_ = kept;
}

}  // namespace plumb::offline::twin
